// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/run/project_input.hpp"
#include "cli/run/write_files.hpp"
#include "cli/verbs/clash/clash_result.hpp"
#include "cli/verbs/draw/draw_stored.hpp"
#include "cli/verbs/verb.hpp"
#include "core/output_format.hpp"
#include "core/text_encoding.hpp"
#include "core/units.hpp"
#include "project/views/stored_views.hpp"
#include "report/report_writers.hpp"
#include "strake/parallel/transform.hpp"
#include "strake/report/view_diff.hpp"

namespace strake::cli {

namespace {

struct DrawDiffOptions {
  ComparedOptions compared;
  std::string view, fail_on, tolerance;
  std::vector<std::string> outputs, match_files;
};

bool fails(const report::ViewDiff& diff, const std::string& fail_on) {
  return !fail_on.empty() && diff.differs(fail_on == "visible");
}

struct ComparedView {
  OpenedProject opened;
  std::string name;
};

/// Opens a project and finds out which of its views is compared: the only one where none is named.
/// Errors: usage.
Result<ComparedView> open_view(Session& session, const DrawDiffOptions& given,
                               const std::string& file) {
  Result<OpenedProject> opened = open_project(session, file);
  if (!opened) return opened.error();
  if (!given.view.empty()) return ComparedView{std::move(*opened), given.view};
  const Result<std::vector<project::StoredView>> views =
      project::list_views(opened->project.database());
  if (!views) return views.error();
  if (views->size() == 1) return ComparedView{std::move(*opened), views->front().name};
  std::string names;
  for (const project::StoredView& view : *views)
    names += (names.empty() ? "add --view: there are " : ", ") + in_quotes(view.name);
  return Error{
      ErrorCode::usage, views->empty() ? "has no view" : "it is not said which view is compared",
      opened->file, views->empty() ? "'strake draw -p FILE --save NAME' makes one" : names};
}

Result<report::ViewDocument> read(Session& session, const DrawDiffOptions& given,
                                  const std::string& file) {
  if (!project::is_project(file)) {
    const auto timer = session.step("read");
    return report::read_view_document(file);
  }
  Result<ComparedView> view = open_view(session, given, file);
  if (!view) return view.error();
  return stored_document(session, view->opened, view->name);
}

/// Reads both documents: of two files, at the same time where there is a team; of one project, what
/// it has stored of the view and what that is now.
Result<std::vector<report::ViewDocument>> read(Session& session, const DrawDiffOptions& given,
                                               const std::vector<std::string>& files) {
  std::vector<report::ViewDocument> documents;
  const auto take = [&](Result<report::ViewDocument> document) -> Status {
    if (!document) return document.error();
    documents.push_back(std::move(*document));
    return {};
  };
  if (files.size() == 1) {
    Result<ComparedView> view = open_view(session, given, files.front());
    if (!view) return view.error();
    if (const Status s = take(stored_document(session, view->opened, view->name)); !s)
      return s.error();
    if (const Status s = take(document_of_now(session, view->opened, view->name)); !s)
      return s.error();
    return documents;
  }
  if (std::ranges::none_of(files, [](const auto& file) { return project::is_project(file); })) {
    const auto timer = session.step("read");
    return parallel::transform(session.context(), {.name = "read drawings", .n = 2},
                               [&](std::size_t i) { return report::read_view_document(files[i]); });
  }
  for (const std::string& file : files)
    if (const Status s = take(read(session, given, file)); !s) return s.error();
  return documents;
}

Status write(Session& session, const DrawDiffOptions& given, const report::ViewDiff& diff) {
  if (const Status status = write_files(session, given.outputs, report::view_diff_writers(), diff);
      !status)
    return status;
  if (!session.json())
    return session.write_stdout(report::view_diff_table(diff, {.width = terminal_width()}));
  return session.write_stdout([&](Session::Sink sink) {
    report::write_view_diff_json(diff, sink);
    return Status{};
  });
}

Result<ExitCode> run_diff(Session& session, const DrawDiffOptions& given, const CLI::App& command) {
  const Result<std::vector<std::string>> files = compared_files(given.compared, command);
  if (!files) return files.error();
  if (!given.view.empty() &&
      std::ranges::none_of(*files, [](const auto& file) { return project::is_project(file); }))
    return Error{ErrorCode::usage, "neither of the two is a project", "--view", "leave it out"};
  if (const Status status = session.files().add_inputs(*files); !status) return status.error();
  if (const Status status =
          session.files().add_outputs(given.outputs, formats_of(report::view_diff_writers()));
      !status)
    return status.error();
  report::ViewDiffOptions options;
  if (const Status status = length_option(options.tolerance_mm, given.tolerance, "--tolerance");
      !status)
    return status.error();
  const auto documents = read(session, given, *files);
  if (!documents) return documents.error();
  const Result<report::ViewDiff> diff = [&] {
    const auto timer = session.step("compare");
    Result<report::FileMatches> matches =
        report::match_files(documents->front(), documents->back(), given.match_files);
    if (!matches) return Result<report::ViewDiff>(matches.error());
    options.files = std::move(*matches);
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
  add_compared_options(*command, options->compared,
                       "Neutral form of the {} drawing, .json or .view",
                       "what its model does to a view since that was drawn last");
  command
      ->add_option("--view", options->view,
                   "The stored view of a project, as it was drawn last (default: the only one)")
      ->type_name("NAME");
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

A project stands for the drawing that it has stored of --view. Alone, that drawing is compared with the view of
the model as it is now, of which lines are solved where something changed; nothing is stored.

Examples:
  strake draw diff monday.view tuesday.view
  strake draw diff ship.strake --view deck -o changes.svg
  strake draw diff -p ship.strake --view deck --fail-on visible
  strake draw diff monday.json ship.strake --view deck
  strake draw diff a.strake b.strake --view deck
  strake draw diff monday.json tuesday.json -o changes.svg -o changes.json --fail-on visible
  strake draw diff monday.json tuesday.json --match-files ship.glb=ship_revB.glb)");
  return {command,
          [options, command](Session& session) { return run_diff(session, *options, *command); }};
}

}  // namespace strake::cli
