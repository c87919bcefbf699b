// SPDX-License-Identifier: Apache-2.0
#include "strake/report/clash_diff.hpp"

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "cli/clash_result.hpp"
#include "cli/verb.hpp"

namespace strake::cli {

namespace {

struct DiffOptions {
  std::string before, after, fail_on;
  std::vector<std::string> outputs;
};

bool fails(const report::ClashDiff& diff, const std::string& fail_on) {
  if (fail_on == "new-hit") return diff.has_new(true);
  if (fail_on == "new") return diff.has_new(false);
  if (fail_on == "worse") return diff.has_worse();
  return fail_on == "cannot-tell" && !diff.cannot_tell.empty();
}

Result<report::ClashDocument> read(Session& session, const std::string& file) {
  const auto timer = session.step("read " + file);
  return report::read_clash_document(file);
}

Result<ExitCode> run_diff(Session& session, const DiffOptions& given) {
  if (const Status status = check_outputs(given.outputs, {".json"}, {given.before, given.after});
      !status)
    return status.error();
  const Result<report::ClashDocument> before = read(session, given.before);
  if (!before) return before.error();
  const Result<report::ClashDocument> after = read(session, given.after);
  if (!after) return after.error();
  const report::ClashDiff diff = [&] {
    const auto timer = session.step("compare");
    return report::compare(*before, *after);
  }();
  for (const std::string& file : given.outputs) {
    const Status status =
        session.write(file, [&](Session::Sink sink) { report::write_clash_diff_json(diff, sink); });
    if (!status) return status.error();
  }
  const Status told =
      session.json()
          ? session.write_stdout(
                [&](Session::Sink sink) { report::write_clash_diff_json(diff, sink); })
          : session.write_stdout(report::clash_diff_table(diff, {.width = terminal_width()}));
  if (!told) return told.error();
  return fails(diff, given.fail_on) ? ExitCode::clashes : ExitCode::done;
}

}  // namespace

Verb add_clash_diff(CLI::App& clash, CommonOptions& common) {
  const auto options = std::make_shared<DiffOptions>();
  CLI::App* const command = clash.add_subcommand(
      "diff", "What changed between two results: new, still there, gone, and what cannot be told");
  command->add_option("old", options->before, "Result of the older run, .json")
      ->type_name("OLD")
      ->required();
  command->add_option("new", options->after, "Result of the newer run, .json")
      ->type_name("NEW")
      ->required();
  add_choice(
      *command, "--fail-on", options->fail_on, {"new-hit", "new", "worse", "cannot-tell"},
      "Exit code 1 where there is a new hit, any new result, a new or worse one, or one that "
      "cannot be told; what a rule allows does not count");
  add_output_option(*command, options->outputs, "Comparison as .json; may be repeated");
  add_common_options(*command, common);
  command->footer(R"(
A clash is the same in both runs when its test, files and durable ids are. It is gone only where the
new run looked at the pair again: an object that is missing, in no set, or exempted, and tolerances
that would no longer report it, are 'cannot tell', with the reason.

Examples:
  strake clash diff monday.json tuesday.json
  strake clash diff monday.json tuesday.json -o changes.json --fail-on new-hit)");
  return {command, [options](Session& session) { return run_diff(session, *options); }};
}

}  // namespace strake::cli
