// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own name
class App;
}  // namespace CLI

namespace strake::cli {

/// An option, or an argument by its place.
struct OptionText {
  std::vector<std::string> names;  ///< "-o", "--output"; of an argument by its place its own
  std::string value;               ///< what its value is, "LENGTH"; empty for a flag
  std::string description, group;
  std::vector<std::string> words;  ///< that the value may be; empty: anything
  bool takes_file = false;
  bool takes_verb = false;  ///< the words of a verb of the program
  bool repeats = false;     ///< may be given more than once
};

/// A command as `--help` tells it: what manual pages and completions are made from.
struct CommandTree {
  std::string name, description, usage, footer;
  std::vector<OptionText> arguments;  ///< by their places
  std::vector<OptionText> options;
  std::vector<CommandTree> verbs;
};

[[nodiscard]] CommandTree command_tree(const CLI::App& program);

/// As troff of the man macros: `man -l FILE` shows it. `path`: of the command, "strake clash diff".
[[nodiscard]] std::string man_page(const CommandTree& command, const std::string& path);

/// What completes command lines in a shell.
[[nodiscard]] std::string bash_completion(const CommandTree& program);
[[nodiscard]] std::string zsh_completion(const CommandTree& program);
[[nodiscard]] std::string fish_completion(const CommandTree& program);

}  // namespace strake::cli
