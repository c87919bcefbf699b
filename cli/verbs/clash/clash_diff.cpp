// SPDX-License-Identifier: Apache-2.0
#include "strake/report/clash_diff.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/verbs/clash/clash_result.hpp"
#include "cli/verbs/verb.hpp"
#include "core/output_format.hpp"
#include "report/report_writers.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::cli {

namespace {

struct ClashDiffOptions {
  std::string before, after, fail_on;
  std::vector<std::string> outputs, match_files;
};

/// Whether the diff fails. A result that may be new, as one without a lasting id may, counts as
/// new.
bool fails(const report::ClashDiff& diff, const std::string& fail_on) {
  if (fail_on == "new-hit") return diff.has_new(true) || diff.maybe_new(true) > 0;
  if (fail_on == "new") return diff.has_new(false) || diff.maybe_new(false) > 0;
  if (fail_on == "worse") return diff.has_worse() || diff.maybe_new(false) > 0;
  return fail_on == "cannot-tell" && !diff.cannot_tell.empty();
}

void print_maybe_new(Session& session, const report::ClashDiff& diff, const std::string& fail_on) {
  if (fail_on.empty() || fail_on == "cannot-tell") return;
  const bool hits_only = fail_on == "new-hit";
  if (const std::size_t count = diff.maybe_new(hits_only); count > 0)
    session.console().note(
        fmt::format("--fail-on {}: {} among 'cannot tell' that may be new, and count as such: {}",
                    fail_on, hits_only ? "hits" : "results", count));
}

/// Reads both documents, at the same time where there is a team.
Result<std::vector<report::ClashDocument>> read(Session& session, const ClashDiffOptions& given) {
  const auto timer = session.step("read");
  return parallel::transform(
      session.context(), {.name = "read results", .n = 2}, [&](std::size_t i) {
        return report::read_clash_document(i == 0 ? given.before : given.after);
      });
}

Result<report::ClashDiff> compare(Session& session, const ClashDiffOptions& given,
                                  const std::vector<report::ClashDocument>& documents) {
  const auto timer = session.step("compare");
  Result<report::FileMatches> files =
      report::match_files(documents.front(), documents.back(), given.match_files);
  if (!files) return files.error();
  return report::compare(documents.front(), documents.back(), std::move(*files));
}

Result<ExitCode> run_diff(Session& session, const ClashDiffOptions& given) {
  if (const Status status = session.files().add_inputs({given.before, given.after}); !status)
    return status.error();
  if (const Status status =
          session.files().add_outputs(given.outputs, formats_of(report::clash_diff_writers()));
      !status)
    return status.error();
  const Result<std::vector<report::ClashDocument>> documents = read(session, given);
  if (!documents) return documents.error();
  const Result<report::ClashDiff> compared = compare(session, given, *documents);
  if (!compared) return compared.error();
  const report::ClashDiff& diff = *compared;
  const auto as_json = [&](Session::Sink sink) {
    report::write_clash_diff_json(diff, sink);
    return Status{};
  };
  for (const std::string& file : given.outputs) {
    const Result<report::ClashDiffWriter> writer = find_writer(report::clash_diff_writers(), file);
    if (!writer) return writer.error();
    const Status status = session.write(file, [&](Session::Sink sink) {
      writer->write(diff, sink);
      return Status{};
    });
    if (!status) return status.error();
  }
  const Status written =
      session.json()
          ? session.write_stdout(as_json)
          : session.write_stdout(report::clash_diff_table(diff, {.width = terminal_width()}));
  if (!written) return written.error();
  print_maybe_new(session, diff, given.fail_on);
  return fails(diff, given.fail_on) ? ExitCode::check_failed : ExitCode::done;
}

}  // namespace

Verb add_clash_diff(CLI::App& clash, CommonOptions& common) {
  const auto options = std::make_shared<ClashDiffOptions>();
  CLI::App* const command = clash.add_subcommand(
      "diff", "What changed between two results: new, still there, gone, and what is undecided");
  command->add_option("old", options->before, "Result of the older run, .json")
      ->type_name("OLD")
      ->required();
  command->add_option("new", options->after, "Result of the newer run, .json")
      ->type_name("NEW")
      ->required();
  add_choice(
      *command, "--fail-on", options->fail_on, {"new-hit", "new", "worse", "cannot-tell"},
      "Exit code 1 where there is a new hit, any new result, a new or worse one, or one that "
      "is undecided; one that may be new counts as new, what a rule allows does not count");
  add_match_files_option(*command, options->match_files);
  add_output_option(*command, options->outputs, "Comparison",
                    formats_of(report::clash_diff_writers()));
  add_common_options(*command, common);
  command->footer(R"(
A clash is the same in both runs when its test, files and durable ids are. It is gone only where the
new run looked at the pair again: an object that is missing, in no set, or exempted, and tolerances
that would no longer report it, are 'cannot tell', with the reason. Where an id is only a position in
its file (an unnamed node, a repeated name), it is the same when class, place and depth are, and else
'cannot tell', in the new run as in the old. A result that does not have as
many pairs as it counts, or otherwise contradicts itself, was cut short or edited and is refused.

A file that has another label than in the old run (a revision in its name, another folder) is found by the
ids of its objects, or by the places of results where it has none; which files were taken as renamed, split or
merged is told first. Two that are equally like it are told and not guessed: --match-files says which it is.

Examples:
  strake clash diff monday.json tuesday.json
  strake clash diff monday.json tuesday.json -o changes.json --fail-on new-hit
  strake clash diff monday.json tuesday.json --match-files ship.glb=ship_revB.glb)");
  return {command, [options](Session& session) { return run_diff(session, *options); }};
}

}  // namespace strake::cli
