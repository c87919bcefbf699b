// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "cli/options/command_tree.hpp"
#include "cli/options/usage_error.hpp"
#include "cli/verbs/verb.hpp"

namespace strake::cli {
namespace {

Result<ExitCode> print(const std::string& text) {
  if (const Status written = write_stdout(text); !written) return written.error();
  return ExitCode::done;
}

Result<ExitCode> print_page(const CLI::App& program, const std::vector<std::string>& verbs) {
  const Result<FoundCommand> found = find_command(program, verbs);
  if (!found) return found.error();
  return print(man_page(command_tree(*found->command), found->path));
}

/// Prints what --help of the command prints.
Result<ExitCode> print_help(const CLI::App& program, const std::vector<std::string>& verbs) {
  const Result<FoundCommand> found = find_command(program, verbs);
  if (!found) return found.error();
  return print(found->command->get_formatter()->make_help(found->command, found->path,
                                                          CLI::AppFormatMode::Normal));
}

}  // namespace

Verb add_help(CLI::App& program) {
  const auto verbs = std::make_shared<std::vector<std::string>>();
  CLI::App* command =
      program.add_subcommand("help", "What --help prints, of the program or of a verb");
  command->add_option("verbs", *verbs, "The verb, as it is typed: clash diff")->type_name("VERB");
  command->footer("Example:\n  strake help clash diff");
  return {command, [&program, verbs](Session&) { return print_help(program, *verbs); }};
}

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
      ->check([](const std::string& given) {
        return given == "bash" || given == "zsh" || given == "fish"
                   ? std::string()
                   : "'" + given + "' is not one of bash|zsh|fish";
      });
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
