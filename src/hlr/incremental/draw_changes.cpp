// SPDX-License-Identifier: Apache-2.0
// The stages of a drawing that follows what changed.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "hlr/incremental/comparison.hpp"
#include "hlr/incremental/extents.hpp"
#include "hlr/incremental/merge.hpp"
#include "hlr/incremental/partial_scene.hpp"
#include "hlr/incremental/reach.hpp"
#include "hlr/incremental/solve_part.hpp"
#include "hlr/prepare/drawn_objects.hpp"
#include "hlr/prepare/view_job.hpp"
#include "hlr/results/object_fates.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/hlr/incremental.hpp"
#include "strake/hlr/steps.hpp"
#include "strake/parallel/report.hpp"

namespace strake::hlr {
namespace {

constexpr std::string_view kMaxOfIt = "what changed reaches most of the drawing";

/// Returns why a view is drawn in full whatever changed; empty where it is not.
std::string_view reason_for_all(const Options& options) {
  if (options.solver != Solver::gather) return "only the solver 'gather' follows changes";
  if (!options.flush_seams) return "which seams are flush depends on neighbours";
  return {};
}

bool describes_all(const EarlierDrawing& earlier) {
  const Drawing& drawing = earlier.drawing;
  const std::size_t objects = earlier.now.size();
  return earlier.boxes.size() == objects && drawing.counted.size() == objects &&
         drawing.account.fates.size() == objects &&
         (drawing.hatches.empty() || drawing.hatches.size() == objects) &&
         drawing.left_out.size() == (drawing.options.hidden ? 0 : objects) &&
         drawing.clipped_left_out.size() == (drawing.options.clipped ? 0 : objects);
}

/// What is requested of draw_changes().
struct RedrawRequest {
  const model::Scene& scene;
  const std::vector<bool>& drawn;
  const View& view;
  const Options& options;
};

Result<Redrawn> draw_all(const RedrawRequest& request, std::string_view why,
                         const parallel::Context& context) {
  auto drawing = draw(request.scene, request.drawn, request.view, request.options, context);
  if (!drawing) return drawing.error();
  Redrawn redrawn{.drawing = std::move(*drawing), .in_full = true, .why = why};
  redrawn.edges_solved = redrawn.drawing.counters.feature_edges;
  redrawn.objects_solved = redrawn.drawing.account.objects();
  return redrawn;
}

/// Solves the lines of the objects that are requested.
Result<Drawing> draw_part(const ChangedView& changed, const ChangeReach& reach,
                          const parallel::Context& context) {
  const PartialScene part = scene_of(changed.scene, reach.needed);
  WholeView whole = changed.whole;
  whole.tessellation = part.plan(changed.tessellation);
  whole.to_solve = reach.to_solve;
  return solve_part({part.scene, reach.needed, changed.view, changed.options, &whole}, context);
}

/// Fills what names the view and the model in a drawing whose lines are there.
void fill_head(const RedrawRequest& request, Drawing& drawing) {
  drawing.view = request.view;
  drawing.options = request.options;
  drawing.weld_mm = request.scene.weld_mm;
  sum_up_lines(drawing);
  report_defects(*request.scene.model, drawing.account, drawing.diagnostics);
}

/// Returns diagnostics without those of defects, which are reported anew.
Diagnostics without_defects(const Diagnostics& all) {
  Diagnostics left;
  for (const Diagnostics::Count& count : all.counts()) {
    if (is_code_of_defect(count.code)) continue;
    std::uint64_t more = count.count;
    for (const Diagnostic& one : all.kept()) {
      if (one.code != count.code) continue;
      left.add(one);
      --more;
    }
    for (; more > 0; --more) left.add(count.severity, count.code, {}, {});
  }
  return left;
}

/// Returns whether a drawing has reports that name objects, those of defects aside.
bool names_objects(const Drawing& drawing) {
  return !without_defects(drawing.diagnostics).counts().empty();
}

/// Returns the earlier drawing where all lines are as they were; objects may have other names.
Redrawn draw_nothing(const RedrawRequest& request, Drawing earlier) {
  Redrawn redrawn{.drawing = std::move(earlier)};
  Drawing& drawing = redrawn.drawing;
  drawing.counters = {.seams = drawing.counters.seams,
                      .uncut_objects = drawing.counters.uncut_objects};
  drawing.diagnostics = {};
  redrawn.touched.assign(request.scene.model->objects.size(), false);
  fill_head(request, drawing);
  return redrawn;
}

/// Returns the objects whose lines were found anew, and those that may have lost theirs.
std::vector<bool> touched_objects(const ChangedView& changed, const ChangeReach& reach) {
  std::vector<bool> touched = reach.to_solve;
  for (std::size_t o = 0; o < touched.size(); ++o)
    touched[o] = touched[o] || changed.comparison.before[o] == model::kNoObject;
  return touched;
}

/// Puts the part that was solved into the earlier drawing.
Result<Redrawn> put_together(const ChangedView& changed, const ChangeReach& reach,
                             const Drawing& part, Drawing earlier,
                             const parallel::Context& context) {
  Redrawn redrawn{.drawing = std::move(earlier)};
  Drawing& drawing = redrawn.drawing;
  const ResolvedLines resolved{reach.to_solve, part};
  if (const Status s = merge_lines(changed.comparison, resolved, drawing, context); !s)
    return s.error();
  if (const Status s = merge_account(changed.scene, changed.drawn, changed.comparison, resolved,
                                     drawing, context);
      !s)
    return s.error();
  redrawn.edges_solved = part.counters.feature_edges;
  redrawn.objects_solved = static_cast<std::uint64_t>(std::ranges::count(reach.to_solve, true));
  if (changed.comparison.same_numbers) redrawn.touched = touched_objects(changed, reach);
  drawing.counters = part.counters;
  drawing.diagnostics = changed.sections ? changed.sections->diagnostics : Diagnostics();
  drawing.diagnostics.append(part.diagnostics);
  drawing.counters.uncut_objects = changed.sections ? changed.sections->uncut_objects : 0;
  drawing.hatches = changed.sections ? changed.sections->hatches : std::vector<Hatch>();
  drawing.origin = part.origin;
  fill_head({changed.scene, changed.drawn, changed.view, changed.options}, drawing);
  return redrawn;
}

/// Cuts all that is drawn where the view has sections.
Result<std::optional<WholeSections>> find_sections(const RedrawRequest& request,
                                                   const parallel::Context& context) {
  const auto& [scene, drawn, view, options] = request;
  if (view.sections.empty()) return std::optional<WholeSections>();
  const parallel::StageTimer timer(context.report, kPreparationStep);
  auto sections = prepare_sections({scene, drawn, view, options}, context);
  if (!sections) return sections.error();
  return std::optional(std::move(*sections));
}

/// What became of objects, and the drawing that they are in.
struct ComparedDrawing {
  Comparison comparison;
  Drawing drawing;
  std::span<const geometry::Box3l> boxes;  ///< as of EarlierDrawing
};

Result<Redrawn> draw_what_changed(const RedrawRequest& request, ComparedDrawing earlier,
                                  const parallel::Context& context) {
  const auto& [scene, drawn, view, options] = request;
  auto sections = find_sections(request, context);
  if (!sections) return sections.error();
  if (*sections)
    mark_changed_hatches(earlier.drawing.hatches, (*sections)->hatches, earlier.boxes,
                         earlier.comparison);
  const auto whole = whole_extent(scene, drawn, view, options, context);
  if (!whole) return whole.error();
  const std::span<const Hatch> hatches =
      *sections ? std::span<const Hatch>((*sections)->hatches) : std::span<const Hatch>();
  const ChangedView changed{scene,
                            drawn,
                            view,
                            options,
                            whole->boxes,
                            earlier.comparison,
                            whole->tessellation,
                            whole->view_of(hatches),
                            std::move(*sections)};
  const auto reach = find_reach(changed, context);
  if (reach && reach->reaches_most) return draw_all(request, kMaxOfIt, context);
  const auto part = reach ? draw_part(changed, *reach, context) : Result<Drawing>(reach.error());
  if (!part) {
    if (part.error().code == ErrorCode::cancelled) return part.error();
    // Limits of a part are others than those of the whole.
    return draw_all(request, "what changed cannot be drawn alone", context);
  }
  auto redrawn = put_together(changed, *reach, *part, std::move(earlier.drawing), context);
  if (!redrawn) return redrawn;
  redrawn->drawing.sag_mm = whole->sag_mm;
  redrawn->drawing.contact_distance_mm =
      changed.sections ? changed.sections->contact_distance_mm
                       : static_cast<double>(whole->drawn.contact) * geometry::kMmPerGrid;
  return redrawn;
}

}  // namespace

Result<Redrawn> draw_changes(const model::Scene& scene, const std::vector<bool>& drawn,
                             const View& view, const Options& options, EarlierDrawing earlier,
                             const parallel::Context& context) {
  const RedrawRequest request{scene, drawn, view, options};
  if (const Status status = check_drawn(scene, drawn); !status) return status.error();
  if (!describes_all(earlier))
    return Error{ErrorCode::usage, "the earlier drawing and what is said of it differ in size",
                 "view", "give a number and a box for each object of that drawing"};
  auto comparison = compare_objects(earlier.now, earlier.boxes, scene.model->objects.size());
  if (!comparison) return comparison.error();
  if (comparison->nothing() && comparison->same_numbers && !names_objects(earlier.drawing))
    return draw_nothing(request, std::move(earlier.drawing));
  if (const std::string_view why = reason_for_all(options); !why.empty())
    return draw_all(request, why, context);
  return draw_what_changed(
      request, {std::move(*comparison), std::move(earlier.drawing), earlier.boxes}, context);
}

}  // namespace strake::hlr
