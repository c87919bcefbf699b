// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/project_page.hpp"

#include <fmt/core.h>

#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/run/load.hpp"
#include "cli/verbs/clash/clash_result.hpp"
#include "cli/verbs/draw/draw_stored.hpp"
#include "project/history/last_run.hpp"
#include "project/results/clash_queries.hpp"
#include "project/results/stored_tests.hpp"
#include "project/views/stored_views.hpp"
#include "publish/form_words.hpp"
#include "strake/drawing/ink.hpp"

namespace strake::cli {

namespace {

/// What a project says of itself.
struct ProjectFacts {
  project::LastRun run;
  project::DecisionsOfNow decisions;
  std::vector<page::TrendPoint> trend;
  std::vector<page::PageDrawing> drawings;
};

Result<std::vector<page::TrendPoint>> trend_of(project::Database& database) {
  const Result<std::vector<project::TrendRow>> rows = project::read_trend(database);
  if (!rows) return rows.error();
  std::vector<page::TrendPoint> trend;
  for (const project::TrendRow& row : *rows)
    trend.push_back({row.run,
                     row.started,
                     row.test,
                     row.hit,
                     row.contact,
                     row.clearance_violation,
                     row.allowed,
                     row.appeared,
                     row.gone,
                     {row.fresh, row.active, row.reviewed, row.approved, row.resolved},
                     row.cannot_tell});
  return trend;
}

/// Returns the stored views as they were drawn last. One that cannot be had is reported and left
/// out.
Result<std::vector<page::PageDrawing>> drawings_of(Session& session, OpenedProject& opened) {
  const Result<std::vector<project::StoredView>> views =
      project::list_views(opened.project.database());
  if (!views) return views.error();
  std::vector<page::PageDrawing> drawings;
  for (const project::StoredView& view : *views) {
    const Result<FormerSheet> sheet = former_sheet(session, opened, view.name);
    if (!sheet) {
      if (sheet.error().code == ErrorCode::cancelled || sheet.error().code == ErrorCode::memory)
        return sheet.error();
      session.console().warn(
          fmt::format("view '{}' is left out: {}", view.name, sheet.error().text()));
      continue;
    }
    const Result<drawing::Ink> ink =
        drawing::choose_ink(sheet->drawing, sheet->ink, session.context());
    if (!ink) return ink.error();
    drawings.push_back(page::page_drawing(sheet->drawing, *ink, sheet->model));
    drawings.back().title = view.name;
  }
  return drawings;
}

Result<ProjectFacts> facts_of(Session& session, OpenedProject& opened) {
  const auto timer = session.step("read results");
  project::Database& database = opened.project.database();
  const Result<std::vector<std::string>> tests = project::last_tests(database);
  if (!tests) return tests.error();
  Result<project::LastRun> run = project::read_last_run(database, *tests, session.context());
  if (!run) return run.error();
  Result<project::DecisionsOfNow> decisions = project::decisions_of_now(database, *run);
  if (!decisions) return decisions.error();
  Result<std::vector<page::TrendPoint>> trend = trend_of(database);
  if (!trend) return trend.error();
  Result<std::vector<page::PageDrawing>> drawings = drawings_of(session, opened);
  if (!drawings) return drawings.error();
  return ProjectFacts{std::move(*run), std::move(*decisions), std::move(*trend),
                      std::move(*drawings)};
}

/// Whether two models have the same objects under the same numbers.
bool has_same_objects(const model::Model& x, const model::Model& y) {
  if (x.objects.size() != y.objects.size()) return false;
  for (std::size_t o = 0; o < x.objects.size(); ++o)
    if (x.objects[o].id != y.objects[o].id ||
        x.files[x.objects[o].file].label != y.files[y.objects[o].file].label)
      return false;
  return true;
}

/// Returns how the run grouped its results; by nothing where it did not.
ClashResultInput grouping_of_run(const project::LastRun& run) {
  ClashResultInput input;
  if (!run.record) return input;
  input.group_by = run.record->grouping.by;
  input.group_distance = run.record->grouping.distance;
  input.group_contacts = run.record->grouping.contacts;
  input.sort = run.record->grouping.sort;
  return input;
}

/// Why the page cannot show the model beside the results; empty where it can.
page::WithoutModel why_without_model(const ProjectFacts& facts, const Result<LoadedModel>& loaded,
                                     const std::string& project) {
  if (!loaded)
    return {"The model cannot be read: " + project + " " + loaded.error().message + ".",
            "What helps: " + loaded.error().mend + ". Then write this report once more."};
  if (facts.run.findings.tests.empty() || has_same_objects(facts.run.model, *loaded->model))
    return {};
  return {
      "The model changed after these results were found, so it is not shown beside them.",
      "'strake clash -p " + project + "' tests it as it is now; then write this report once more."};
}

Status put_together(Session& session, const std::string& geometry, const OpenedProject& opened,
                    const Result<LoadedModel>& loaded, ProjectFacts& facts, const PageTaker& take) {
  const project::LastRun& run = facts.run;
  const bool has_results = !run.findings.tests.empty();
  page::WithoutModel without =
      why_without_model(facts, loaded, opened.project.path().filename().string());
  const bool is_as_tested = without.why.empty();
  if (!loaded)
    session.console().warn(
        fmt::format("the page has no model, which cannot be read: {}", loaded.error().text()));
  else if (!is_as_tested)
    session.console().warn(
        "the model changed since the last run: the page has its results without the model "
        "('strake clash -p' tests what there is now)");
  const model::Model& model = is_as_tested ? *loaded->model : run.model;
  const Result<std::optional<clash::Grouping>> grouping =
      group(session, grouping_of_run(run), run.findings, model, &facts.decisions.decided);
  if (!grouping) return grouping.error();
  const Diagnostics loading = is_as_tested ? loaded->diagnostics() : Diagnostics();
  const report::ClashContents clash{run.findings,
                                    model,
                                    *grouping ? &**grouping : nullptr,
                                    run.record && run.record->rules ? &*run.record->rules : nullptr,
                                    is_as_tested ? &loading : nullptr,
                                    {},
                                    {},
                                    {},
                                    &facts.decisions.decided};
  const auto assignee = [&](const page::PageRow& row) -> std::string_view {
    const auto at = facts.decisions.clashes.find(run.rows[row.test][row.pair]);
    return at == facts.decisions.clashes.end() ? std::string_view() : at->second.row.assignee;
  };
  page::PageContents page{opened.project.path().filename().string(),
                          model,
                          has_results ? &clash : nullptr,
                          assignee,
                          is_as_tested ? &loaded->scene : nullptr,
                          publish::model_shown(geometry),
                          std::move(without),
                          {},
                          std::move(facts.drawings),
                          std::move(facts.trend)};
  return take(page);
}

}  // namespace

Status make_project_page(Session& session, OpenedProject& opened, const std::string& geometry,
                         const PageTaker& take) {
  Result<ProjectFacts> facts = facts_of(session, opened);
  if (!facts) return facts.error();
  // The page shows curves coarser than any test needs them.
  const Result<LoadedModel> loaded = load_project(session, opened, {});
  // Results are worth a page although their model cannot be read.
  const bool has_results = !facts->run.findings.tests.empty();
  if (!loaded && (loaded.error().code != ErrorCode::input || !has_results)) return loaded.error();
  return put_together(session, geometry, opened, loaded, *facts, take);
}

}  // namespace strake::cli
