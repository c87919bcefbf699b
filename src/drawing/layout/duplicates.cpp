// SPDX-License-Identifier: Apache-2.0
#include "drawing/layout/duplicates.hpp"

#include <algorithm>

#include "strake/geometry/grid.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::drawing {

namespace {

using geometry::Vec3d;
using geometry::Vec3l;

OverlapRank rank_of(hlr::State state) {
  switch (state) {
    case hlr::State::visible:
      return OverlapRank::visible;
    case hlr::State::hidden_by_self:
    case hlr::State::hidden_by_other:
      return OverlapRank::hidden;
    case hlr::State::projecting:
    case hlr::State::clipped:
      break;
  }
  return OverlapRank::none;
}

/// Returns a piece in the plane of the view.
PlaneSegment flat_of(const hlr::EdgePiece& piece, const Vec3l& direction, const ViewPlane& plane,
                     double reach) {
  const PlanePoint a = plane(piece.a), b = plane(piece.b);
  PlaneSegment flat{.ax = a.x,
                    .ay = a.y,
                    .bx = b.x,
                    .by = b.y,
                    .depth = nearness(direction, piece.a, piece.b),
                    .reach = reach * std::max(a.magnification, b.magnification)};
  if (flat.length() > 0) flat.rank = rank_of(piece.state);
  return flat;
}

PaperPoint between(const PaperPoint& a, const PaperPoint& b, double t) {
  return {rounded_paper(a.x + (b.x - a.x) * t), rounded_paper(a.y + (b.y - a.y) * t)};
}

}  // namespace

bool is_hidden(LineState state) {
  return state == LineState::hidden_by_self || state == LineState::hidden_by_other;
}

Line part_of(const Line& line, const PaperAxes& axes, double from, double to) {
  Line part = line;
  const auto at = [&](double share) {
    const double t = axes.share_in_model(line.a_mm, line.b_mm, share);
    // Rounded to the grid's micrometre: more digits would be meaningless.
    return Vec3d{rounded_paper(line.a_mm.x + (line.b_mm.x - line.a_mm.x) * t),
                 rounded_paper(line.a_mm.y + (line.b_mm.y - line.a_mm.y) * t),
                 rounded_paper(line.a_mm.z + (line.b_mm.z - line.a_mm.z) * t)};
  };
  if (from > 0) {
    part.a_mm = at(from);
    part.a_paper = between(line.a_paper, line.b_paper, from);
  }
  if (to < 1) {
    part.b_mm = at(to);
    part.b_paper = between(line.a_paper, line.b_paper, to);
  }
  return part;
}

Result<std::vector<PlaneSegment>> flatten(const hlr::Drawing& drawing, const PaperAxes& axes,
                                          double distance_mm, const parallel::Context& context) {
  const std::span<const hlr::EdgePiece> pieces = drawing.pieces;
  const ViewPlane plane(axes, drawing.origin);
  return parallel::transform(
      context, {.name = "lines in the plane", .n = pieces.size(), .grain = 8192},
      [&](std::size_t i) {
        return flat_of(pieces[i], drawing.view.direction, plane, distance_mm / 2);
      });
}

OverlapRule duplicate_rule(double distance_mm) {
  return {.least = distance_mm, .shortest = distance_mm};
}

Result<LineOverlaps> find_duplicates(const hlr::Drawing& drawing, const PaperAxes& axes,
                                     double distance_mm, const parallel::Context& context) {
  const auto flat = flatten(drawing, axes, distance_mm, context);
  if (!flat) return flat.error();
  return cut_overlaps(*flat, duplicate_rule(distance_mm), context);
}

}  // namespace strake::drawing
