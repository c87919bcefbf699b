// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/verbs/clash/clash_result.hpp"
#include "cli/verbs/verb.hpp"
#include "core/output_format.hpp"
#include "core/units.hpp"
#include "report/report_writers.hpp"
#include "strake/parallel/transform.hpp"
#include "strake/report/view_diff.hpp"

namespace strake::cli {

namespace {

struct DrawDiffOptions {
  std::string before, after, fail_on, tolerance;
  std::vector<std::string> outputs, match_files;
};

bool fails(const report::ViewDiff& diff, const std::string& fail_on) {
  return !fail_on.empty() && diff.differs(fail_on == "visible");
}

/// Reads both documents, at the same time where there is a team.
Result<std::vector<report::ViewDocument>> read(Session& session, const DrawDiffOptions& given) {
  const auto timer = session.step("read");
  return parallel::transform(
      session.context(), {.name = "read drawings", .n = 2}, [&](std::size_t i) {
        return report::read_view_document(i == 0 ? given.before : given.after);
      });
}

Status write(Session& session, const DrawDiffOptions& given, const report::ViewDiff& diff) {
  for (const std::string& file : given.outputs) {
    const Result<report::ViewDiffWriter> writer = find_writer(report::view_diff_writers(), file);
    if (!writer) return writer.error();
    const Status status = session.write(file, [&](Session::Sink sink) {
      writer->write(diff, sink);
      return Status{};
    });
    if (!status) return status;
  }
  if (!session.json())
    return session.write_stdout(report::view_diff_table(diff, {.width = terminal_width()}));
  return session.write_stdout([&](Session::Sink sink) {
    report::write_view_diff_json(diff, sink);
    return Status{};
  });
}

Result<ExitCode> run_diff(Session& session, const DrawDiffOptions& given) {
  if (const Status status = session.files().add_inputs({given.before, given.after}); !status)
    return status.error();
  if (const Status status =
          session.files().add_outputs(given.outputs, formats_of(report::view_diff_writers()));
      !status)
    return status.error();
  report::ViewDiffOptions options;
  if (const Status status = length_option(options.tolerance_mm, given.tolerance, "--tolerance");
      !status)
    return status.error();
  const auto documents = read(session, given);
  if (!documents) return documents.error();
  const Result<report::ViewDiff> diff = [&] {
    const auto timer = session.step("compare");
    Result<report::FileMatches> files =
        report::match_files(documents->front(), documents->back(), given.match_files);
    if (!files) return Result<report::ViewDiff>(files.error());
    options.files = std::move(*files);
    return report::compare(documents->front(), documents->back(), options, session.context());
  }();
  if (!diff) return diff.error();
  if (const Status status = write(session, given, *diff); !status) return status.error();
  return fails(*diff, given.fail_on) ? ExitCode::check_failed : ExitCode::done;
}

}  // namespace

Verb add_draw_diff(CLI::App& draw, CommonOptions& common) {
  const auto options = std::make_shared<DrawDiffOptions>();
  CLI::App* const command = draw.add_subcommand(
      "diff",
      "What changed between two drawings of a view: lines that are new, gone, of another "
      "class, with a picture");
  command->add_option("old", options->before, "Neutral form of the older drawing, .json or .view")
      ->type_name("OLD")
      ->required();
  command->add_option("new", options->after, "Neutral form of the newer drawing, .json or .view")
      ->type_name("NEW")
      ->required();
  add_choice(*command, "--fail-on", options->fail_on, {"visible", "any"},
             "Exit code 1 where a line that is or was visible is new, gone or of another class, or "
             "any line is");
  command
      ->add_option("--tolerance", options->tolerance,
                   "Lines no farther apart than this lie on each other (default 2um)")
      ->type_name("LENGTH");
  add_match_files_option(*command, options->match_files);
  add_output_option(*command, options->outputs, "Comparison",
                    formats_of(report::view_diff_writers()));
  add_common_options(*command, common);
  command->footer(R"(
Lines are compared in the model, place by place: a line that is cut into other pieces is the same, and so is
a drawing at another scale. A line of another kind, state or object at the same place has changed. Drawings
that look from different sides are refused, and so is a file that does not have as many lines as it counts.
Other settings that differ are told first, and objects that only one of the drawings left out (--limits auto).
A model file that has another label than in the old drawing is found by the ids of its objects, or by the places
of its lines; what was taken as renamed, split or merged is told first (--match-files for what cannot be told).

Examples:
  strake draw diff monday.view tuesday.view
  strake draw diff monday.json tuesday.json -o changes.svg -o changes.json --fail-on visible
  strake draw diff monday.json tuesday.json --match-files ship.glb=ship_revB.glb)");
  return {command, [options](Session& session) { return run_diff(session, *options); }};
}

}  // namespace strake::cli
