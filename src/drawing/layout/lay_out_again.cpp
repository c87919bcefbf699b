// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "drawing/layout/placement.hpp"
#include "drawing/layout/view_plane.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/reduce.hpp"

namespace strake::drawing {

namespace {

using geometry::Vec3l;

// Ends of lines are whole micrometres within twice the range of what can be placed.
Vec3l grid_of(const geometry::Vec3d& mm) {
  const auto um = [](double v) {
    return static_cast<std::int64_t>(std::llround(v * geometry::kGridPerMm));
  };
  return {um(mm.x), um(mm.y), um(mm.z)};
}

/// Returns the box of the lines that are not clipped, about a point of the model.
Result<PlaneBox> extent_of(const NeutralDrawing& drawing, const PaperAxes& axes,
                           const Vec3l& origin, const parallel::Context& context) {
  const ViewPlane plane(axes, origin);
  Result<PlaneBox> box = parallel::reduce(
      context, {.name = "extent of lines", .n = drawing.lines.size(), .grain = 65536}, kNoPlaneBox,
      [&](PlaneBox& part, std::size_t i) {
        const Line& line = drawing.lines[i];
        if (line.state == LineState::clipped) return;
        for (const geometry::Vec3d& end : {line.a_mm, line.b_mm}) {
          const PlanePoint p = plane(grid_of(end));
          part.include({p.x, p.x, p.y, p.y});
        }
      },
      [](PlaneBox& into, const PlaneBox& part) { into.include(part); });
  if (box && box->left > box->right) *box = {};
  return box;
}

/// Whether the end of a line lies where the plane puts it. A cut of it is rounded in the model and
/// on paper.
bool lies_there(const PaperPoint& on_paper, const geometry::Vec3d& mm, const PaperPlane& plane) {
  constexpr double kRoundedMm = 2e-3;
  const Vec3l grid = grid_of(mm);
  const PaperPoint there = plane(grid);
  const double off = std::max(std::fabs(there.x - on_paper.x), std::fabs(there.y - on_paper.y));
  return off <= kRoundedMm + 2 * plane.grid_on_paper(grid);
}

Status check_places(const NeutralDrawing& drawing, const PaperPlane& plane,
                    const parallel::Context& context) {
  const auto wrong = parallel::reduce(
      context, {.name = "places of lines", .n = drawing.lines.size(), .grain = 65536},
      std::uint64_t{0},
      [&](std::uint64_t& count, std::size_t i) {
        const Line& line = drawing.lines[i];
        if (line.state == LineState::clipped) return;
        if (!lies_there(line.a_paper, line.a_mm, plane) ||
            !lies_there(line.b_paper, line.b_mm, plane))
          ++count;
      },
      [](std::uint64_t& into, const std::uint64_t& count) { into += count; });
  if (!wrong) return wrong.error();
  if (*wrong == 0) return {};
  return Error{
      ErrorCode::input,
      std::to_string(*wrong) +
          " lines do not lie on the sheet where the view and its scale put them: it cannot "
          "be put on another sheet",
      {},
      "leave out --scale and --paper, or draw the model again"};
}

/// Moves the curves with the lines. Only orthographic views have any.
void move_curves(PaperCurves& curves, const Placement& from, const Placement& to) {
  const double factor = from.sheet.scale / to.sheet.scale;
  for (PaperCurve& curve : curves.all) {
    curve.centre = {to.at.x + (curve.centre.x - from.at.x) * factor,
                    to.at.y + (curve.centre.y - from.at.y) * factor};
    curve.u = {curve.u.x * factor, curve.u.y * factor};
    curve.v = {curve.v.x * factor, curve.v.y * factor};
  }
}

bool are_alike(const Sheet& x, const Sheet& y) {
  return x.width_mm == y.width_mm && x.height_mm == y.height_mm && x.scale == y.scale;
}

}  // namespace

Result<NeutralDrawing> lay_out_again(NeutralDrawing drawing, const LayoutOptions& options,
                                     const parallel::Context& context) {
  if (!options.title.empty()) drawing.title = options.title;
  if (!options.scale && !options.paper) return drawing;
  if (const Status status = check_scale(options); !status) return status.error();
  const auto axes = paper_axes(drawing.view);
  if (!axes) return Error{ErrorCode::input, "its view has no plane", {}, "draw the model again"};
  Vec3l anchor;
  if (drawing.view.perspective)
    anchor = drawing.view.perspective->target;
  else if (!drawing.lines.empty())
    anchor = grid_of(drawing.lines.front().a_mm);
  const Result<PlaneBox> box = extent_of(drawing, *axes, anchor, context);
  if (!box) return box.error();
  const Result<Placement> to = choose_placement(*box, anchor, options);
  if (!to) return to.error();
  if (are_alike(to->sheet, drawing.sheet)) return drawing;
  const Placement from = in_the_middle(*box, drawing.sheet, anchor);
  if (const Status status = check_places(drawing, PaperPlane(*axes, from), context); !status)
    return status.error();
  const PaperPlane on_paper(*axes, *to);
  const Status moved = parallel::for_each(
      context, {.name = "lines on another sheet", .n = drawing.lines.size(), .grain = 8192},
      [&](std::size_t i) {
        Line& line = drawing.lines[i];
        line.a_paper = on_paper(grid_of(line.a_mm));
        line.b_paper = on_paper(grid_of(line.b_mm));
      });
  if (!moved) return moved.error();
  move_curves(drawing.curves, from, *to);
  drawing.sheet = to->sheet;
  drawing.frame = frame_of(drawing, *to);
  return drawing;
}

}  // namespace strake::drawing
