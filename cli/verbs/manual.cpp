// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "cli/options/command_tree.hpp"
#include "cli/verbs/verb.hpp"

namespace strake::cli {
namespace {

Result<ExitCode> print(const std::string& text) {
  if (const Status written = write_stdout(text); !written) return written.error();
  return ExitCode::done;
}

Result<ExitCode> print_page(const CLI::App& program, const std::vector<std::string>& verbs) {
  const CommandTree tree = command_tree(program);
  const CommandTree* command = &tree;
  std::string path = tree.name;
  for (const std::string& verb : verbs) {
    const auto found = std::ranges::find(command->verbs, verb, &CommandTree::name);
    if (found == command->verbs.end())
      return Error{.code = ErrorCode::usage,
                   .message = "'" + path + "' has no verb '" + verb + "'",
                   .where = {},
                   .mend = "'" + path + " --help' tells what there is"};
    command = &*found;
    path += " " + verb;
  }
  return print(man_page(*command, path));
}

}  // namespace

Verb add_man(CLI::App& program) {
  const auto verbs = std::make_shared<std::vector<std::string>>();
  CLI::App* command =
      program.add_subcommand("man", "The manual page of the program or of a verb, for man");
  command->add_option("verbs", *verbs, "The verb, as it is typed: clash diff")->type_name("VERB");
  command->footer("Example:\n  strake man clash diff | man -l -");
  return {command, [&program, verbs](Session&) { return print_page(program, *verbs); }};
}

Verb add_completion(CLI::App& program) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* command =
      program.add_subcommand("completion", "What completes command lines of strake in a shell");
  command->add_option("shell", *shell, "bash, zsh or fish")
      ->required()
      ->type_name("bash|zsh|fish")
      ->check(CLI::IsMember({"bash", "zsh", "fish"}).description(""));
  command->footer(
      "An installed strake has them where shells look. Otherwise, for example:\n"
      "  strake completion bash > ~/.local/share/bash-completion/completions/strake");
  return {command, [&program, shell](Session&) {
            const CommandTree tree = command_tree(program);
            return print(*shell == "bash"  ? bash_completion(tree)
                         : *shell == "zsh" ? zsh_completion(tree)
                                           : fish_completion(tree));
          }};
}

}  // namespace strake::cli
