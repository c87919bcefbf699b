// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/run/project_input.hpp"
#include "cli/verbs/clash/clash_groups.hpp"
#include "cli/verbs/clash/clash_lines.hpp"
#include "cli/verbs/verb.hpp"
#include "core/output_format.hpp"

namespace strake::cli {

namespace {

constexpr std::array<OutputFormat, 2> kFormats{{{".csv"}, {".json"}}};

struct ClashListOptions {
  ProjectOptions project;
  std::string status, key;
  std::optional<std::string> test;
  std::vector<std::string> outputs;
  bool groups = false;
  ClashGroupingInput grouping;
};

Result<OpenedProject> open(Session& session, const ClashListOptions& given) {
  if (given.project.file.empty())
    return Error{ErrorCode::usage, "no project is given", "-p", "write -p FILE"};
  if (const Status status = session.files().add_outputs(given.outputs, kFormats); !status)
    return status.error();
  return open_project(session, given.project, project::Access::read);
}

/// Writes lines to the files, and to standard output as a table or JSON.
Result<ExitCode> put_out(Session& session, const ClashListOptions& given, const ClashLines& lines) {
  for (const std::string& file : given.outputs) {
    const Status status = session.write(file, [&](Session::Sink sink) {
      sink(suffix_of(file) == ".csv" ? lines.csv() : lines.json());
      return Status{};
    });
    if (!status) return status.error();
  }
  if (!given.outputs.empty() && !session.json()) return ExitCode::done;
  const Status written = session.write_stdout(session.json() ? lines.json() : lines.table());
  if (!written) return written.error();
  return ExitCode::done;
}

Result<ExitCode> run_list(Session& session, const ClashListOptions& given) {
  if (const Status status = check(given.grouping); !status) return status.error();
  Result<OpenedProject> opened = open(session, given);
  if (!opened) return opened.error();
  project::ClashFilter filter;
  filter.test = given.test;
  for (const report::DecisionStatus status : report::kDecisionStatuses)
    if (name(status) == given.status) filter.status = status;
  const Result<std::vector<project::ListedClash>> clashes =
      project::list_clashes(opened->project.database(), filter);
  if (!clashes) return clashes.error();
  if (!given.groups && given.grouping.first_given() == nullptr)
    return put_out(session, given, lines_of(*clashes));
  const Result<std::vector<ProjectGroup>> groups =
      groups_of_last_run(session, *opened, given.grouping);
  if (!groups) return groups.error();
  return put_out(session, given, lines_of(*clashes, &*groups));
}

Result<ExitCode> run_history(Session& session, const ClashListOptions& given) {
  Result<OpenedProject> opened = open(session, given);
  if (!opened) return opened.error();
  if (!given.key.empty()) {
    const Result<std::vector<project::ClashEvent>> events =
        project::read_events(opened->project.database(), given.key);
    if (!events) return events.error();
    return put_out(session, given, lines_of(*events));
  }
  const Result<std::vector<project::TrendRow>> trend =
      project::read_trend(opened->project.database());
  if (!trend) return trend.error();
  return put_out(session, given, lines_of(*trend));
}

void add_list_options(CLI::App& command, ClashListOptions& options, CommonOptions& common) {
  add_project_options(command, options.project,
                      "The project whose clashes and runs are told (docs/project.md)");
  add_output_option(command, options.outputs, "The list", kFormats);
  add_common_options(command, common);
}

}  // namespace

Verb add_clash_list(CLI::App& clash, CommonOptions& common) {
  const auto options = std::make_shared<ClashListOptions>();
  CLI::App* const command = clash.add_subcommand(
      "list", "The clashes that a project remembers, with what was decided about them");
  add_choice(*command, "--status", options->status,
             {"new", "active", "reviewed", "approved", "resolved"}, "Those of this status");
  // An empty name is that of the test of the command line.
  command
      ->add_option_function<std::string>(
          "--test", [options](const std::string& name) { options->test = name; },
          "Those of this test; '' is the test of the command line")
      ->type_name("NAME|''");
  add_list_options(*command, *options, common);
  command
      ->add_flag(
          "--groups", options->groups,
          "The group of each clash in the report of the last run too: its number, and its key "
          "for 'strake clash set --group'")
      ->group("Groups");
  add_grouping_options(*command, options->grouping);
  command->footer(R"(
The CSV is a file of decisions, as 'strake clash --decisions' takes it.

Examples:
  strake clash list -p ship.strake --status new
  strake clash list -p ship.strake --groups
  strake clash list -p ship.strake --group-by assembly --status active
  strake clash list -p ship.strake -o decided.csv)");
  return {command, [options](Session& session) { return run_list(session, *options); }};
}

Verb add_clash_history(CLI::App& clash, CommonOptions& common) {
  const auto options = std::make_shared<ClashListOptions>();
  CLI::App* const command = clash.add_subcommand(
      "history",
      "The runs that a project remembers, with their numbers, or what became of a clash");
  command->add_option("key", options->key, "What became of the clash with this key")
      ->type_name("KEY");
  add_list_options(*command, *options, common);
  command->footer(R"(
Examples:
  strake clash history -p ship.strake
  strake clash history -p ship.strake -o trend.csv
  strake clash history -p ship.strake 0c8x2kq9w3e4r5t6y7v8b9n0mz)");
  return {command, [options](Session& session) { return run_history(session, *options); }};
}

}  // namespace strake::cli
