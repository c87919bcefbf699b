// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "cli/output/console.hpp"
#include "cli/verbs/verb.hpp"
#include "rules/profiles.hpp"

namespace strake::cli {

namespace {

std::string profile_list() {
  std::string text;
  for (const rules::Profile& profile : rules::profiles())
    text += fmt::format("{:<10}{}\n", profile.name, profile.about);
  return text;
}

std::vector<std::string> profile_names() {
  std::vector<std::string> names;
  for (const rules::Profile& profile : rules::profiles()) names.emplace_back(profile.name);
  return names;
}

}  // namespace

Verb add_rules_verb(CLI::App& program) {
  const auto name = std::make_shared<std::string>();
  CLI::App* const command =
      program.add_subcommand("rules", "The rules files that 'strake clash --profile' takes");
  command->require_subcommand(1);
  CLI::App* const list = command->add_subcommand("list", "The profiles, one a line");
  CLI::App* const show = command->add_subcommand("show", "The rules file of a profile");
  const std::vector<std::string> names = profile_names();
  show->add_option("profile", *name, "The profile, as 'strake rules list' names it")
      ->required()
      ->type_name(fmt::format("{}", fmt::join(names, "|")))
      ->check(CLI::IsMember(names).description(""));
  command->footer("\n'strake rules show --help' tells its options.");
  list->footer("Example:\n  strake rules list");
  show->footer(
      "A file of your own begins with it; --rules takes that in place of --profile.\n"
      "Example:\n  strake rules show plant > project.toml");
  return {command, [list, name](Session&) -> Result<ExitCode> {
            const Status written = write_stdout(
                list->parsed() ? profile_list() : std::string(rules::find_profile(*name)->text));
            if (!written) return written.error();
            return ExitCode::done;
          }};
}

}  // namespace strake::cli
