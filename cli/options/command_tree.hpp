// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own name
class App;
}  // namespace CLI

namespace strake::cli {

/// An option, or a positional argument.
struct OptionText {
  std::vector<std::string> names;  ///< "-o", "--output"; the name of a positional argument
  std::string value;               ///< what its value is, "LENGTH"; empty for a flag
  std::string description, group;
  std::vector<std::string> words;  ///< words that the value may be; empty: anything
  bool takes_file = false;
  bool takes_verb = false;  ///< the words of a verb of the program
  bool repeats = false;     ///< may be given more than once
};

/// A command as `--help` describes it, from which manual pages and completions are made.
struct CommandTree {
  std::string name, description, usage, footer;
  std::vector<OptionText> arguments;  ///< positional ones, in their order
  std::vector<OptionText> options;
  std::vector<CommandTree> verbs;
};

[[nodiscard]] CommandTree command_tree(const CLI::App& program);

/// Returns a page in troff of the man macros, which `man -l FILE` shows. `path` is the command's,
/// "strake clash diff".
[[nodiscard]] std::string man_page(const CommandTree& command, const std::string& path);

/// Return the script that completes command lines in a shell.
[[nodiscard]] std::string bash_completion(const CommandTree& program);
[[nodiscard]] std::string zsh_completion(const CommandTree& program);
[[nodiscard]] std::string fish_completion(const CommandTree& program);

}  // namespace strake::cli
