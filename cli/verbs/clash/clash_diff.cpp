// SPDX-License-Identifier: Apache-2.0
#include "strake/report/clash_diff.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/run/project_input.hpp"
#include "cli/run/write_files.hpp"
#include "cli/verbs/clash/clash_result.hpp"
#include "cli/verbs/verb.hpp"
#include "core/output_format.hpp"
#include "core/text_encoding.hpp"
#include "project/history/compare_runs.hpp"
#include "project/history/last_document.hpp"
#include "report/report_writers.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::cli {

namespace {

struct ClashDiffOptions {
  ComparedOptions compared;
  std::optional<std::string> test;
  std::vector<std::int64_t> runs;  ///< two, or none
  std::string fail_on;
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

/// Errors: usage for options that need a project, or a project alone.
Status check(Session& session, const ClashDiffOptions& given,
             const std::vector<std::string>& files) {
  const bool any_project =
      std::ranges::any_of(files, [](const std::string& file) { return project::is_project(file); });
  if (given.test && !any_project)
    return Error{ErrorCode::usage, "neither of the two is a project", "--test", "leave it out"};
  if (!given.runs.empty() && given.runs.size() != 2)
    return Error{ErrorCode::usage, "two runs are compared", "--runs", "write it as --runs 3 7"};
  if (!given.runs.empty() && files.size() > 1)
    return Error{ErrorCode::usage, "only runs of one project have numbers", "--runs",
                 "compare the project alone, or leave it out"};
  if (!given.match_files.empty() && files.size() == 1)
    return Error{ErrorCode::usage, "a project follows its files itself", "--match-files",
                 "leave it out; 'strake project update' takes it"};
  if (Status status = session.files().add_inputs(files); !status) return status;
  return session.files().add_outputs(given.outputs, formats_of(report::clash_diff_writers()));
}

/// A comparison, and what it refers to.
struct Compared {
  std::vector<report::ClashDocument> documents;
  std::unique_ptr<project::RunComparison> of_runs;  ///< of one project
  report::ClashDiff of_documents;

  [[nodiscard]] const report::ClashDiff& diff() const {
    return of_runs ? of_runs->diff : of_documents;
  }
};

Result<report::ClashDocument> read(Session& session, const ClashDiffOptions& given,
                                   const std::string& file) {
  if (!project::is_project(file)) return report::read_clash_document(file);
  Result<OpenedProject> opened = open_project(session, file);
  if (!opened) return opened.error();
  return project::last_document(opened->project.database(), given.test, session.context());
}

/// Reads both documents; two files at the same time where there is a team.
Result<std::vector<report::ClashDocument>> read(Session& session, const ClashDiffOptions& given,
                                                const std::vector<std::string>& files) {
  const auto timer = session.step("read");
  // Opening a project tells the session which files are read, one at a time.
  if (std::ranges::any_of(files, [](const std::string& f) { return project::is_project(f); })) {
    std::vector<report::ClashDocument> documents;
    for (const std::string& file : files) {
      Result<report::ClashDocument> document = read(session, given, file);
      if (!document) return document.error();
      documents.push_back(std::move(*document));
    }
    return documents;
  }
  return parallel::transform(session.context(), {.name = "read results", .n = 2},
                             [&](std::size_t i) { return read(session, given, files[i]); });
}

Result<Compared> compare_files(Session& session, const ClashDiffOptions& given,
                               const std::vector<std::string>& files) {
  Result<std::vector<report::ClashDocument>> documents = read(session, given, files);
  if (!documents) return documents.error();
  Compared compared{std::move(*documents), nullptr, {}};
  const report::ClashDocument &before = compared.documents.front(),
                              &after = compared.documents.back();
  const auto timer = session.step("compare");
  Result<report::FileMatches> matches = report::match_files(before, after, given.match_files);
  if (!matches) return matches.error();
  compared.of_documents = report::compare(before, after, std::move(*matches));
  return compared;
}

/// Returns how many results both runs counted in a test, in one line.
std::string counts_text(const project::TestCounts& test) {
  const project::ResultCounts &was = test.before, &is = test.after;
  return fmt::format(
      "{}counted: {} -> {} hits, {} -> {} contacts, {} -> {} clearance violations, {} -> {} "
      "allowed by rules",
      test.test.empty() ? std::string() : "test " + in_quotes(test.test) + ": ", was.hit, is.hit,
      was.contact, is.contact, was.clearance_violation, is.clearance_violation, was.allowed,
      is.allowed);
}

Result<Compared> compare_runs(Session& session, const ClashDiffOptions& given,
                              const std::string& file) {
  Result<OpenedProject> opened = open_project(session, file);
  if (!opened) return opened.error();
  project::ComparedRuns request{given.test, {}};
  if (!given.runs.empty()) request.runs.emplace(given.runs.front(), given.runs.back());
  const auto timer = session.step("compare");
  Result<std::unique_ptr<project::RunComparison>> made =
      project::compare_runs(opened->project.database(), request);
  if (!made) {
    Error error = made.error();
    if (error.where.empty()) error.where = opened->file;
    return error;
  }
  session.console().note((*made)->before.name + " against " + (*made)->after.name);
  for (const project::TestCounts& test : (*made)->counts) session.console().note(counts_text(test));
  return Compared{{}, std::move(*made), {}};
}

Result<ExitCode> run_diff(Session& session, const ClashDiffOptions& given,
                          const CLI::App& command) {
  const Result<std::vector<std::string>> files = compared_files(given.compared, command);
  if (!files) return files.error();
  if (const Status status = check(session, given, *files); !status) return status.error();
  const Result<Compared> compared = files->size() == 1
                                        ? compare_runs(session, given, files->front())
                                        : compare_files(session, given, *files);
  if (!compared) return compared.error();
  const report::ClashDiff& diff = compared->diff();
  const auto as_json = [&](Session::Sink sink) {
    report::write_clash_diff_json(diff, sink);
    return Status{};
  };
  if (const Status status = write_files(session, given.outputs, report::clash_diff_writers(), diff);
      !status)
    return status.error();
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
  add_compared_options(*command, options->compared, "Result of the {} run, .json",
                       "its last two runs");
  // An empty name is that of the test of the command line.
  command
      ->add_option_function<std::string>(
          "--test", [options](const std::string& name) { options->test = name; },
          "The test of a project, of which its last run counts (default: all tests of its last "
          "run); '' is the test of the command line")
      ->type_name("NAME|''");
  command
      ->add_option("--runs", options->runs,
                   "Compare these runs of a project, the older first; 'strake clash history' has "
                   "their numbers (default: the last two)")
      ->type_name("N")
      ->expected(2)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
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

A project stands for its last run, beside a file or another project. Alone, two of its runs are compared by
what each said of each clash: what was new in between is new, what was resolved is gone, and what the run
could not tell is 'cannot tell', as the run had it. What has no row of its own, contacts that are only counted
and results that a rule has allowed all along, is compared by its number alone: a line has what both counted.

Examples:
  strake clash diff monday.json tuesday.json
  strake clash diff ship.strake
  strake clash diff -p ship.strake --runs 3 7
  strake clash diff monday.json ship.strake --test hvac
  strake clash diff a.strake b.strake
  strake clash diff monday.json tuesday.json -o changes.json --fail-on new-hit
  strake clash diff monday.json tuesday.json --match-files ship.glb=ship_revB.glb)");
  return {command,
          [options, command](Session& session) { return run_diff(session, *options, *command); }};
}

}  // namespace strake::cli
