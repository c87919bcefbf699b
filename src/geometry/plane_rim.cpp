// SPDX-License-Identifier: Apache-2.0
#include "geometry/plane_rim.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "geometry/box.hpp"
#include "geometry/tree_walk.hpp"
#include "strake/geometry/part_edges.hpp"
#include "strake/geometry/predicates.hpp"
#include "strake/geometry/wide_int.hpp"

namespace strake::geometry {

/// Of two segments whose boxes meet: where all lies in one line these have told.
bool PlaneRim::share_point(const std::array<Vec3l, 2>& s, const std::array<Vec3l, 2>& t) const {
  const auto parted_by = [&](const std::array<Vec3l, 2>& x, const std::array<Vec3l, 2>& y) {
    return orient2d(x[0], x[1], y[0], axis_) * orient2d(x[0], x[1], y[1], axis_) > 0;
  };
  return !parted_by(s, t) && !parted_by(t, s);
}

PlaneRim::PlaneRim(const PartView& view, std::span<const std::uint32_t> triangles, int axis)
    : view_(view), axis_(axis) {
  const Part& part = view.part();
  const auto in_plane = [&](std::uint32_t t) { return std::ranges::binary_search(triangles, t); };
  std::vector<Triangle> segments;
  for (const std::uint32_t t : triangles) {
    const Triangle& c = part.triangles[t];
    for (int i = 0; i < 3; ++i) {
      const auto from = c[static_cast<std::size_t>(i)],
                 to = c[static_cast<std::size_t>((i + 1) % 3)];
      const auto round = triangles_round(part, edge_between(part, from, to));
      if (round.size() == 2 && in_plane(round[0]) && in_plane(round[1])) continue;
      sides_.push_back({t, i});
      segments.push_back({from, to, to});
    }
  }
  if (!triangles.empty()) {
    const auto c = view.corners(triangles.front());
    facing_ = orient2d(c[0], c[1], c[2], axis);
  }
  segments_.vertices = part.vertices;
  segments_.triangles = std::move(segments);
  tree_ = PartTree(segments_);
}

std::array<Vec3l, 2> PlaneRim::ends(const TriangleSide& side) const {
  const Triangle& c = view_.part().triangles[side.triangle];
  const auto i = static_cast<std::size_t>(side.number);
  return {view_.vertex(c[i]), view_.vertex(c[(i + 1) % 3])};
}

bool PlaneRim::meets(const std::array<Vec3l, 2>& segment) const {
  const Box3l box = box_of(segment);
  return !walk_tree(
      tree_, [&](const PartTree::Node& node) { return view_.box(node.box).meets(box); },
      [&](std::uint32_t i) {
        const std::array<Vec3l, 2> other = ends(sides_[i]);
        return !box_of(other).meets(box) || !share_point(segment, other);
      });
}

std::optional<std::uint32_t> PlaneRim::face_round(const Vec3l& p) const {
  const int along = (axis_ + 1) % 3, across = (axis_ + 2) % 3;
  const auto near = [&](const PartTree::Node& node) {
    const Box3l box = view_.box(node.box);
    return box.hi[along] >= p[along] && box.lo[across] <= p[across] && box.hi[across] >= p[across];
  };
  // A ray along the first coordinate; a side has its lower end, not its upper one.
  int winding = 0;
  std::optional<std::uint32_t> nearest;
  Int128 first = 0, first_rise = 0;
  (void)walk_tree(tree_, near, [&](std::uint32_t i) {
    auto [low, high] = ends(sides_[i]);
    if ((low[across] <= p[across]) == (high[across] <= p[across])) return true;
    const int up = low[across] < high[across] ? 1 : -1;
    if (up < 0) std::swap(low, high);
    if (orient2d(low, high, p, axis_) < 0) return true;  // the ray starts beyond it
    winding += up;
    if (up != facing_) return true;  // the face lies on the far side
    // Where it is met, from p on: a ratio.
    const Int128 rise = high[across] - low[across];
    const Int128 way = (low[along] - p[along]) * rise +
                       Int128{p[across] - low[across]} * (high[along] - low[along]);
    if (!nearest || way * first_rise < first * rise) {
      nearest = sides_[i].triangle;
      first = way;
      first_rise = rise;
    }
    return true;
  });
  return winding == 0 ? std::nullopt : nearest;
}

}  // namespace strake::geometry
