// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/draw/draw_run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "cli/run/load.hpp"
#include "cli/run/object_selection.hpp"
#include "cli/run/session.hpp"
#include "cli/verbs/draw/brute_force_cost.hpp"
#include "cli/verbs/draw/draw_summary.hpp"
#include "cli/verbs/draw/styles/style_option.hpp"
#include "core/number.hpp"
#include "core/output_format.hpp"
#include "drawing/drawing_writers.hpp"
#include "drawing/layout/far_objects.hpp"
#include "drawing/layout/view_plane.hpp"
#include "publish/drawing_formats.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/write.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"

namespace strake::cli {
namespace {

/// "1:50 on 420 x 297 mm"
std::string sheet_text(const drawing::PlaneBox& box, const drawing::LayoutOptions& layout) {
  const drawing::Sheet sheet = drawing::choose_sheet(box, layout);
  return fmt::format("{} on {} x {} mm", sheet.scale_text, sheet.width_mm, sheet.height_mm);
}

/// Looks for objects that lie so far from all others that they decide the scale of a view. It takes
/// them out of `drawn` and names them in `layout` where they are to be left out, and warns of them
/// otherwise. Errors: cancelled.
Status resolve_far_objects(Session& session, const model::Scene& scene, const hlr::View& view,
                           bool leave_out, std::vector<bool>& drawn,
                           drawing::LayoutOptions& layout) {
  const Result<drawing::FarObjects> far =
      drawing::find_far_objects(scene, drawn, view, session.context());
  if (!far) return far.error();
  if (far->objects.empty()) return {};
  const std::string text = drawing::far_objects_text(*far, *scene.model);
  const bool one = far->objects.size() == 1;
  if (!leave_out) {
    session.console().note(fmt::format(
        "warning far-object: {}: the view is about {} for {}, without {} {} (--limits auto leaves "
        "{} out)",
        text, sheet_text(far->whole, layout), one ? "it" : "them", one ? "it" : "them",
        sheet_text(far->rest, layout), one ? "it" : "them"));
    return {};
  }
  drawing::leave_out(*far, *scene.model, drawn);
  layout.far_left_out = far->objects;
  session.stats().count("far objects left out", far->objects.size());
  session.console().note(fmt::format("note far-object-left-out: {} and {} left out (--limits auto)",
                                     text, one ? "is" : "are"));
  return {};
}

}  // namespace

Status draw_pipes_as_lines(Session& session, const DrawRequest& request, model::Scene& scene) {
  if (!request.single_line) return {};
  auto lines = model::pipes_as_lines(scene, *request.single_line, session.context());
  if (!lines) return lines.error();
  scene = std::move(lines->scene);
  session.stats().count("single-line pipes", lines->bodies);
  session.console().note(fmt::format("{} {} of pipes drawn as single lines (up to {} mm)",
                                     lines->bodies, lines->bodies == 1 ? "piece" : "pieces",
                                     shortest(request.single_line->largest_diameter_mm)));
  return {};
}

Result<PreparedView> prepare_view(Session& session, const DrawRequest& request,
                                  const model::Scene& scene) {
  PreparedView prepared{{}, request.options, request.layout};
  Result<std::vector<bool>> drawn = pick_any(session, scene, request.selections, "--select");
  if (!drawn) return drawn.error();
  prepared.drawn = std::move(*drawn);
  if (const Status status = resolve_far_objects(session, scene, request.view, !request.far_objects,
                                                prepared.drawn, prepared.layout);
      !status)
    return status.error();
  auto hatches = hatches_of(session, scene, request.hatches);
  if (!hatches) return hatches.error();
  prepared.options.hatches = std::move(*hatches);
  auto uncut = pick_any(session, scene, request.uncut, "--uncut");
  if (!uncut) return uncut.error();
  prepared.options.uncut = std::move(*uncut);
  for (const model::Selection& selection : request.uncut)
    prepared.layout.uncut_selections.push_back(selection.text());
  if (!request.sag_for_paper) return prepared;
  const Result<double> sag = drawing::sag_for_paper(scene, prepared.drawn, request.view,
                                                    prepared.layout, session.context());
  if (!sag) return sag.error();
  prepared.options.sag_mm = *sag;
  return prepared;
}

Result<hlr::Drawing> solve(Session& session, const DrawRequest& request,
                           const PreparedView& prepared, const model::Scene& scene) {
  if (prepared.options.solver == hlr::Solver::brute_force)
    if (const Status status =
            print_brute_force_cost(session, scene, prepared.drawn, request.view, prepared.options);
        !status)
      return status.error();
  const auto timer = session.step("hidden lines");
  return hlr::draw(scene, prepared.drawn, request.view, prepared.options, session.context());
}

Result<drawing::NeutralDrawing> put_on_paper(Session& session, const hlr::Drawing& lines,
                                             const model::Model& model,
                                             const drawing::LayoutOptions& layout) {
  print_diagnostics(session.console(), lines.diagnostics);
  const auto timer = session.step("layout");
  return drawing::lay_out(lines, model, layout, session.context());
}

namespace {

void count_work(Stats& stats, const drawing::NeutralDrawing& drawing) {
  const hlr::Counters& work = drawing.counters;
  count_objects(stats, drawing.account, "");
  stats.count("feature edges", work.feature_edges);
  stats.count("covered edges", work.covered_edges);
  stats.count("face tests", work.face_tests);
  stats.count("exact fall-backs", work.exact_fallbacks);
  stats.count("intersection pairs", work.crossing_pairs);
  stats.count("intersection tests", work.crossing_tests);
  stats.count("specks", work.specks);
  stats.count("edges with hidden pieces left out", work.left_out);
  if (drawing.uncut) stats.count("objects uncut", work.uncut_objects);
  if (!drawing.flush_seams) stats.count("edges with flush seams left out", work.seams);
  for (std::size_t s = 0; s < drawing::kLineStates; ++s)
    stats.count(fmt::format("lines {}", drawing::state_name(static_cast<drawing::LineState>(s))),
                drawing.count[s]);
}

void print_drawing_summary(Console& console, const drawing::NeutralDrawing& drawing,
                           const model::Model& model) {
  const auto of = [&](drawing::LineState state) {
    return drawing.count[static_cast<std::size_t>(state)];
  };
  const std::uint64_t visible = of(drawing::LineState::visible);
  const std::uint64_t lines =
      std::accumulate(drawing.count.begin(), drawing.count.end(), std::uint64_t{0});
  console.note(object_summary_line(drawing.account, model));
  console.note(fmt::format("{} visible of {} lines at {} on {} x {} mm", visible, lines,
                           scale_words(drawing), drawing.sheet.width_mm, drawing.sheet.height_mm));
  for (const std::string& line : left_alone_lines(drawing)) console.note(line);
  if (visible > 0) return;
  console.note(of(drawing::LineState::clipped) > 0
                   ? "warning empty-sheet: nothing is left to draw inside the limits, the field of "
                     "view and the sections"
                   : "warning empty-sheet: the model has nothing to draw");
}

/// Says what thinning left out, and how many break lines there are.
void print_conventions(Session& session, const drawing::Conventions& conventions,
                       const drawing::Ink& ink) {
  if (ink.thinned) {
    session.stats().count("lines thinned", ink.thinned->lines);
    session.console().note(thinned_line(*ink.thinned));
  }
  if (conventions.break_lines) session.stats().count("break lines", ink.break_lines.size());
}

}  // namespace

void report_drawing(Session& session, const drawing::NeutralDrawing& drawing,
                    const model::Model& model) {
  count_work(session.stats(), drawing);
  print_drawing_summary(session.console(), drawing, model);
}

Status write_drawing(Session& session, const DrawOptions& given,
                     const drawing::NeutralDrawing& drawing, const model::Model& model,
                     const model::Scene* scene) {
  std::vector<drawing::DrawingWriter> writers;
  for (const std::string& file : given.outputs) {
    const Result<drawing::DrawingWriter> writer = publish::find_drawing_writer(file);
    if (!writer) return writer.error();
    writers.push_back(*writer);
  }
  drawing::Ink ink;
  if (std::any_of(writers.begin(), writers.end(),
                  std::mem_fn(&drawing::DrawingWriter::needs_ink))) {
    const auto timer = session.step("ink");
    drawing::InkOptions options = ink_options(given);
    if (scene != nullptr) {
      const auto rules = parse_styles(given.styles);
      if (!rules) return rules.error();
      auto styles = styles_of(session, *scene, *rules);
      if (!styles) return styles.error();
      options.styles = std::move(*styles);
    }
    Result<drawing::Ink> chosen = drawing::choose_ink(drawing, options, session.context());
    if (!chosen) return chosen.error();
    ink = std::move(*chosen);
    const auto conventions = conventions_of(given);
    if (!conventions) return conventions.error();
    if (const Status status =
            drawing::apply_conventions(ink, drawing, model, *conventions, session.context());
        !status)
      return status;
    print_conventions(session, *conventions, ink);
  }
  for (std::size_t i = 0; i < writers.size(); ++i) {
    Diagnostics noticed;
    const Status status = session.write(given.outputs[i], [&](Session::Sink sink) -> Status {
      Result<Diagnostics> written =
          writers[i].write({drawing, ink, model, scene}, sink, session.context());
      if (!written) return written.error();
      noticed = std::move(*written);
      return {};
    });
    if (!status) return status;
    print_diagnostics(session.console(), noticed, {"text-character-missing"});
  }
  if (!session.json()) return {};
  return session.write_stdout([&](Session::Sink sink) {
    return drawing::write_view_json(drawing, model, sink, session.context());
  });
}

}  // namespace strake::cli
