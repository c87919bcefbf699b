// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/draw/draw_stored.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/run/project_input.hpp"
#include "cli/verbs/draw/draw_run.hpp"
#include "cli/verbs/draw/draw_summary.hpp"
#include "cli/verbs/draw/view_settings.hpp"
#include "core/stopwatch.hpp"
#include "project/snapshot/snapshot.hpp"
#include "project/views/drawing_codec.hpp"
#include "project/views/stored_views.hpp"
#include "strake/drawing/write.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/hlr/incremental.hpp"
#include "strake/hlr/steps.hpp"
#include "strake/parallel/report.hpp"

namespace strake::cli {

namespace {

/// The view, as it is requested and as the project has it.
struct ViewOfProject {
  std::string name;
  DrawOptions solved;  ///< whose lines are those of the view
  DrawOptions shown;   ///< the same on the sheet that this run requests
};

/// How the lines of a view came about.
struct SolvedView {
  hlr::Drawing drawing;
  ViewWork work;
  std::vector<bool> touched = {};  ///< hlr::Redrawn::touched, of the drawing that was stored
};

/// Seconds of the steps of hidden lines, from when it was made.
class StepTimes {
 public:
  explicit StepTimes(Session& session) : report_(session.measured()), before_(all()) {}

  void add_to(ViewWork& work) const {
    const std::array<double, 3> now = all();
    work.solve_s = lap_.seconds();
    work.preparation_s = now[0] - before_[0];
    work.local_s = now[1] - before_[1];
    work.global_s = now[2] - before_[2];
  }

 private:
  [[nodiscard]] std::array<double, 3> all() const {
    std::array<double, 3> seconds{};
    for (const parallel::StageReport& stage : report_.stages())
      for (std::size_t i = 0; i < kSteps.size(); ++i)
        if (stage.name == kSteps[i]) seconds[i] = stage.wall_s;
    return seconds;
  }

  static constexpr std::array<std::string_view, 3> kSteps{hlr::kPreparationStep, hlr::kLocalStep,
                                                          hlr::kGlobalStep};
  const parallel::RunReport& report_;
  std::array<double, 3> before_;
  Stopwatch lap_;
};

/// Fills what the drawing tells of the work.
void count_lines(SolvedView& solved) {
  const hlr::Counters& counters = solved.drawing.counters;
  solved.work.stage = solved.drawing.options.stage;
  solved.work.objects = solved.drawing.account.fates.size();
  solved.work.edges = counters.feature_edges;
  solved.work.shared_bodies = counters.shared_bodies;
  solved.work.shared_shapes = counters.shared_shapes;
}

Result<ViewOfProject> view_to_draw(const DrawOptions& given, OpenedProject& opened) {
  if (!given.save.empty()) return ViewOfProject{given.save, given, given};
  if (const std::string option = first_option_of_lines(given); !option.empty())
    return Error{ErrorCode::usage, "the view '" + given.stored + "' is drawn as it was saved",
                 option, "leave it out, or make another view: --save NAME"};
  const auto stored = project::find_view(opened.project.database(), given.stored);
  if (!stored) {
    Error error = stored.error();
    error.where = opened.file;
    return error;
  }
  Result<DrawOptions> options =
      parse_settings(stored->settings, opened.file + ": view '" + given.stored + "'");
  if (!options) return options.error();
  ViewOfProject view{given.stored, *options, *options};
  put_on_sheet_of(given, view.shown);
  view.shown.outputs = given.outputs;
  if (view.solved.visible_only && ink_options(view.shown).hidden)
    return Error{ErrorCode::usage, "the view '" + given.stored + "' has no hidden lines",
                 "--hidden", "save it again without --visible-only"};
  return view;
}

/// What the lines of a view are a function of.
struct ViewState {
  project::Snapshot snapshot;
  std::vector<geometry::Box3l> boxes;  ///< hlr::Signatures::boxes
};

Result<ViewState> state_of(Session& session, const DrawRequest& request,
                           const PreparedView& prepared, const model::Scene& scene) {
  const auto timer = session.step("signatures");
  auto signatures =
      hlr::signatures(scene, prepared.drawn, request.view, prepared.options, session.context());
  if (!signatures) return signatures.error();
  auto identities = project::identities(*scene.model, session.context());
  if (!identities) return identities.error();
  return ViewState{{signatures->view, std::move(*identities), std::move(signatures->objects)},
                   std::move(signatures->boxes)};
}

/// Returns the drawing that is remembered, if any of it may serve. What is damaged serves nobody:
/// everything is solved then.
Result<std::optional<project::StoredDrawing>> remembered(Session& session, OpenedProject& opened,
                                                         const std::string& name,
                                                         const project::Snapshot& now) {
  const auto timer = session.step("stored lines");
  auto stored =
      project::load_drawing(opened.project.database(), name, now.whole, session.context());
  if (stored || stored.error().code != ErrorCode::input) return stored;
  session.console().warn(fmt::format("{}: all lines are solved anew", stored.error().text()));
  return std::optional<project::StoredDrawing>();
}

/// Counts the objects of then that are gone or other ones now, and those of now that are new.
std::size_t count_changed(const std::vector<std::uint32_t>& now_of, std::size_t objects_now) {
  const auto gone = static_cast<std::size_t>(std::ranges::count(now_of, model::kNoObject));
  // An object that changed is gone and new.
  const std::size_t kept = now_of.size() - gone;
  return std::max(gone, objects_now - std::min(objects_now, kept));
}

/// Finds the lines by what changed since they were stored, which it takes.
Result<SolvedView> solve_changes(Session& session, const DrawRequest& request,
                                 const PreparedView& prepared, const model::Scene& scene,
                                 project::StoredDrawing& stored, const project::Snapshot& now) {
  SolvedView solved{.drawing = {}, .work = {.run = ViewRun::unchanged}};
  // Reports have names of objects, which signatures do not see.
  if (stored.made_from == now && stored.drawing.diagnostics.counts().empty()) {
    solved.drawing = std::move(stored.drawing);
    solved.drawing.view = request.view;
    solved.drawing.options = prepared.options;
    count_lines(solved);
    return solved;
  }
  const Stopwatch lap;
  const auto now_of = [&] {
    const auto timer = session.step("match");
    return project::unchanged(stored.made_from, now, session.context());
  }();
  if (!now_of) return now_of.error();
  solved.work.match_s = lap.seconds();
  solved.work.objects_changed = count_changed(*now_of, now.identities.size());
  const auto timer = session.step("hidden lines");
  const StepTimes steps(session);
  Result<hlr::Redrawn> redrawn =
      hlr::draw_changes(scene, prepared.drawn, request.view, prepared.options,
                        {std::move(stored.drawing), *now_of, stored.boxes}, session.context());
  if (!redrawn) return redrawn.error();
  steps.add_to(solved.work);
  solved.drawing = std::move(redrawn->drawing);
  solved.work.edges_solved = redrawn->edges_solved;
  solved.work.objects_solved = redrawn->objects_solved;
  solved.work.why = redrawn->why;
  solved.touched = std::move(redrawn->touched);
  if (redrawn->in_full)
    solved.work.run = ViewRun::in_full;
  else if (solved.work.objects_changed > 0 || redrawn->objects_solved > 0)
    solved.work.run = ViewRun::followed;
  count_lines(solved);
  return solved;
}

Result<SolvedView> solve_in_full(Session& session, const DrawRequest& request,
                                 const PreparedView& prepared, const model::Scene& scene,
                                 ViewRun run, std::string_view why) {
  const StepTimes steps(session);
  Result<hlr::Drawing> drawing = solve(session, request, prepared, scene);
  if (!drawing) return drawing.error();
  SolvedView solved{.drawing = std::move(*drawing), .work = {.run = run, .why = std::string(why)}};
  steps.add_to(solved.work);
  count_lines(solved);
  solved.work.objects_changed = scene.model->objects.size();
  solved.work.objects_solved = solved.drawing.account.objects();
  solved.work.edges_solved = solved.work.edges;
  return solved;
}

/// Stores what a run has found. A view that is only drawn again is drawn even where the project
/// cannot be written, as on read-only media: the run says so.
Status remember(Session& session, const DrawOptions& given, const project::ViewToStore& view) {
  const auto timer = session.step("remember");
  const Status status = [&]() -> Status {
    Result<OpenedProject> opened = open_project(session, given.project, project::Access::write);
    if (!opened) return opened.error();
    return project::store_view(opened->project.database(), view, session.context());
  }();
  if (status || !given.save.empty() || status.error().code == ErrorCode::cancelled) return status;
  session.console().note(fmt::format("the lines of view '{}' are not remembered: {}", view.name,
                                     status.error().text()));
  return {};
}

/// Tells where this run's scale would have had finer curves than the lines have.
void note_coarse_curves(Session& session, const drawing::NeutralDrawing& drawing,
                        const hlr::Drawing& lines) {
  constexpr double kVisibleMm = 0.051;  // on paper; a little more than sag_for_paper() allows
  if (lines.curves.edges.empty() || lines.sag_mm <= kVisibleMm * drawing.sheet.scale) return;
  session.console().note(
      fmt::format("curves are as fine as the view was saved for, within {:.2g} mm; at {} that may "
                  "show: --save the view with this scale for finer ones",
                  lines.sag_mm, drawing.sheet.scale_text));
}

/// A run for one view whose model is on the grid.
class StoredRun {
 public:
  StoredRun(Session& session, const DrawOptions& given, const ViewOfProject& view,
            const DrawRequest& request, const LoadedModel& loaded)
      : session_(session), given_(given), view_(view), request_(request), loaded_(loaded) {}

  /// Finds the lines, and what they are made from.
  Status find_lines(OpenedProject& opened) {
    Result<PreparedView> prepared = prepare_view(session_, request_, loaded_.scene);
    if (!prepared) return prepared.error();
    prepared_ = std::move(*prepared);
    const Stopwatch lap;
    Result<ViewState> now = state_of(session_, request_, prepared_, loaded_.scene);
    if (!now) return now.error();
    const double signatures_s = lap.seconds();
    now_ = std::move(*now);
    now_.snapshot.names = loaded_.names;
    Result<SolvedView> solved = solved_view(opened);
    if (!solved) return solved.error();
    solved_ = std::move(*solved);
    solved_.work.match_s += signatures_s;
    count_view_work(session_.stats(), solved_.work);
    session_.console().note(did_line(view_.name, solved_.work));
    session_.console().note(cost_line(view_.name, solved_.work));
    return given_.verify ? verify() : Status{};
  }

  Result<drawing::NeutralDrawing> lay_out() {
    drawing::LayoutOptions layout = prepared_.layout;
    const Result<drawing::LayoutOptions> shown = layout_options(view_.shown);
    if (!shown) return shown.error();
    layout.scale = shown->scale;
    layout.paper = shown->paper;
    layout.title = shown->title;
    Result<drawing::NeutralDrawing> drawing =
        put_on_paper(session_, solved_.drawing, *loaded_.model, layout);
    if (!drawing) return drawing;
    if (request_.sag_for_paper) note_coarse_curves(session_, *drawing, solved_.drawing);
    return drawing;
  }

  /// Stores the view as it was requested, and its lines where they are not those that are stored.
  Status store() {
    project::ViewToStore view;
    view.name = view_.name;
    const std::string settings = settings_text(given_);
    if (!given_.save.empty()) view.settings = settings;
    if (!kept_) {
      view.drawing = &solved_.drawing;
      view.made_from = &now_.snapshot;
      view.boxes = &now_.boxes;
      view.model = loaded_.model.get();
      view.far_objects = prepared_.layout.far_left_out;
      view.edges_solved = solved_.work.edges_solved;
      view.seconds = solved_.work.solve_s;
      if (stored_) view.stored = &*stored_;
      view.touched = &solved_.touched;
    }
    return view.settings || view.drawing != nullptr ? remember(session_, given_, view) : Status{};
  }

  [[nodiscard]] bool differs() const { return differs_; }

 private:
  Result<SolvedView> solved_view(OpenedProject& opened) {
    if (given_.full)
      return solve_in_full(session_, request_, prepared_, loaded_.scene, ViewRun::in_full,
                           "as asked");
    const Stopwatch lap;
    auto stored = remembered(session_, opened, view_.name, now_.snapshot);
    if (!stored) return stored.error();
    stored_ = std::move(*stored);
    const double read_s = lap.seconds();
    Result<SolvedView> solved = [&] {
      if (!stored_)
        return solve_in_full(session_, request_, prepared_, loaded_.scene, ViewRun::made,
                             "nothing is remembered of it that holds now");
      kept_ = stored_->made_from == now_.snapshot;
      return solve_changes(session_, request_, prepared_, loaded_.scene, *stored_, now_.snapshot);
    }();
    if (solved) solved->work.read_s = read_s;
    return solved;
  }

  /// Solves everything, and takes that where it is another drawing.
  Status verify() {
    Result<SolvedView> full =
        solve_in_full(session_, request_, prepared_, loaded_.scene, ViewRun::in_full, "to verify");
    if (!full) return full.error();
    const Result<bool> equal = [&] {
      const auto timer = session_.step("compare");
      return project::are_equal(full->drawing, solved_.drawing);
    }();
    if (!equal) return equal.error();
    if (*equal) {
      session_.console().note(fmt::format("view '{}': the same lines in full, in {:.2f} s",
                                          view_.name, full->work.solve_s));
      return {};
    }
    differs_ = true;
    kept_ = false;
    session_.console().warn(
        fmt::format("view '{}': the lines that were kept are not those of a drawing in full, which "
                    "is taken instead",
                    view_.name));
    solved_ = std::move(*full);
    return {};
  }

  Session& session_;
  const DrawOptions& given_;
  const ViewOfProject& view_;
  const DrawRequest& request_;
  const LoadedModel& loaded_;
  PreparedView prepared_;
  ViewState now_;
  SolvedView solved_;
  /// What the project has of the view, but for the lines, which `solved_` took; none: nothing that
  /// may serve.
  std::optional<project::StoredDrawing> stored_;
  bool kept_ = false;     ///< the lines are those that are stored
  bool differs_ = false;  ///< from the drawing in full
};

/// Returns a drawing as a comparison reads it; `name` is what it calls it.
Result<report::ViewDocument> document_of(Session& session, const drawing::NeutralDrawing& drawing,
                                         const model::Model& model, const std::string& name) {
  const auto timer = session.step("document");
  std::stringstream rows;
  const Status written = drawing::write_view_rows(
      drawing, model, [&](std::string_view piece) { rows << piece; }, session.context());
  if (!written) return written.error();
  return report::parse_view_document(rows, name);
}

/// Returns a view of a project as options: it is drawn again as it was saved.
DrawOptions as_stored(const OpenedProject& opened, const std::string& view) {
  DrawOptions given;
  given.project.file = opened.file;
  given.stored = view;
  return given;
}

}  // namespace

Result<FormerSheet> former_sheet(Session& session, OpenedProject& opened, const std::string& view) {
  const Result<ViewOfProject> view_request = view_to_draw(as_stored(opened, view), opened);
  if (!view_request) return view_request.error();
  Result<project::FormerDrawing> former = [&] {
    const auto timer = session.step("stored lines");
    return project::former_drawing(opened.project.database(), view, session.context());
  }();
  if (!former) {
    Error error = former.error();
    if (error.where.empty()) error.where = opened.file;
    return error;
  }
  const Result<DrawRequest> request = request_of(view_request->solved, session, true);
  if (!request) return request.error();
  drawing::LayoutOptions layout = request->layout;
  layout.far_left_out = std::move(former->far_objects);
  for (const model::Selection& selection : request->uncut)
    layout.uncut_selections.push_back(selection.text());
  Result<drawing::NeutralDrawing> drawing =
      drawing::lay_out(former->drawing, former->model, layout, session.context());
  if (!drawing) return drawing.error();
  return FormerSheet{std::move(*drawing), std::move(former->model),
                     ink_options(view_request->shown)};
}

Result<report::ViewDocument> stored_document(Session& session, OpenedProject& opened,
                                             const std::string& view) {
  const Result<FormerSheet> former = former_sheet(session, opened, view);
  if (!former) return former.error();
  return document_of(session, former->drawing, former->model,
                     opened.file + ", view '" + view + "' as stored");
}

Result<report::ViewDocument> document_of_now(Session& session, OpenedProject& opened,
                                             const std::string& view) {
  const DrawOptions given = as_stored(opened, view);
  const Result<ViewOfProject> view_request = view_to_draw(given, opened);
  if (!view_request) return view_request.error();
  const Result<DrawRequest> request = request_of(view_request->solved, session, true);
  if (!request) return request.error();
  Result<LoadedModel> loaded = load_project(session, opened, request->scene);
  if (!loaded) return loaded.error();
  if (const Status status = draw_pipes_as_lines(session, *request, loaded->scene); !status)
    return status.error();
  StoredRun run(session, given, *view_request, *request, *loaded);
  if (const Status status = run.find_lines(opened); !status) return status.error();
  const Result<drawing::NeutralDrawing> drawing = run.lay_out();
  if (!drawing) return drawing.error();
  return document_of(session, *drawing, *loaded->model,
                     opened.file + ", view '" + view + "' of the model of now");
}

Result<ExitCode> draw_stored(Session& session, const DrawOptions& given) {
  Result<OpenedProject> opened = open_project(session, given.project, project::Access::read);
  if (!opened) return opened.error();
  std::optional<OpenedProject> reader(std::move(*opened));
  const Result<ViewOfProject> view = view_to_draw(given, *reader);
  if (!view) return view.error();
  const Result<DrawRequest> request = request_of(view->solved, session, true);
  if (!request) return request.error();
  Result<LoadedModel> loaded = load_project(session, *reader, request->scene);
  if (!loaded) return loaded.error();
  if (const Status status = draw_pipes_as_lines(session, *request, loaded->scene); !status)
    return status.error();
  StoredRun run(session, given, *view, *request, *loaded);
  if (const Status status = run.find_lines(*reader); !status) return status.error();
  // What is stored is in the file itself once nobody else has it open.
  reader.reset();
  const Result<drawing::NeutralDrawing> drawing = run.lay_out();
  if (!drawing) return drawing.error();
  report_drawing(session, *drawing, *loaded->model);
  if (const Status status = run.store(); !status) return status.error();
  if (const Status status =
          write_drawing(session, view->shown, *drawing, *loaded->model, &loaded->scene);
      !status)
    return status.error();
  return run.differs() ? ExitCode::check_failed : strict_exit_code(given.input, *loaded);
}

}  // namespace strake::cli
