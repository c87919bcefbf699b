// SPDX-License-Identifier: Apache-2.0
#include "geometry/contact_regions/slab_candidates.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "geometry/distance/hull_distance.hpp"
#include "geometry/distance/slab_proximity.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "geometry/obb/rotated_part.hpp"
#include "geometry/obb/sweep_and_prune.hpp"
#include "geometry/primitive_pairs/solvers/gjk.hpp"

namespace strake::geometry {

SlabHeights project_on_slab_axis(const PairLocalPart& a, const PairLocalPart& b, double reach) {
  const SupportTree none;
  const Vec3d n =
      primitive_pairs::gjk_distance(convex_hull_body(a.part(), none, a.shift().as<double>()),
                                    convex_hull_body(b.part(), none, b.shift().as<double>()))
          .normal;
  return {a, b, n, reach};
}

SlabCandidates facing(const PairLocalPart& a, const PairLocalPart& b, double reach) {
  SlabCandidates facing{.heights = project_on_slab_axis(a, b, reach)};
  const SlabHeights& heights = facing.heights;
  facing.triangles_a = heights.a.below(heights.level_a);
  facing.triangles_b = heights.b.below(heights.level_b);
  std::vector<bool> listed(a.part().vertices.size(), false);
  for (const std::uint32_t t : facing.triangles_a)
    for (const std::uint32_t v : a.part().triangles[t]) listed[v] = true;
  for (std::uint32_t v = 0; v < listed.size(); ++v)
    if (listed[v]) facing.vertices_a.push_back(v);
  const auto& edges = a.part().edges;
  for (std::uint32_t e = 0; e + 1 < edges.size(); ++e)
    if (listed[edges[e].v0] && listed[edges[e].v1]) facing.edges_a.push_back(e);
  return facing;
}

namespace {

/// Number of facing pairs per triangle of the two parts above which a rotated frame costs less than
/// the pairs left by boxes along the coordinate axes. Two corrugated boxes on each other, askew, of
/// 2,040 triangles take 2.6 CPU ms with sorted boxes in such a frame, 9.0 before (decision 0012).
constexpr std::size_t kManyFacing = 32;

std::optional<Axes> axes_that_fit(const PairLocalPart& a, const PairLocalPart& b,
                                  const SlabCandidates& facing) {
  const std::size_t triangles = a.part().triangles.size() + b.part().triangles.size();
  const bool many = facing.triangles_a.size() * facing.triangles_b.size() > kManyFacing * triangles;
  if (!many || !a.has_bvh() || !b.has_bvh()) return std::nullopt;
  return sliver_axes(a, b);
}

std::vector<Vec3d> vertices_along(const PairLocalPart& view, const std::optional<Axes>& axes) {
  std::vector<Vec3d> along;
  along.reserve(view.part().vertices.size());
  for (std::uint32_t v = 0; v < view.part().vertices.size(); ++v) {
    const Vec3d p = view.vertex(v).as<double>();
    along.push_back(axes ? turned(*axes, p) : p);
  }
  return along;
}

std::vector<Box3d> boxes_of_vertices(const std::vector<Vec3d>& at,
                                     const std::vector<std::uint32_t>& some) {
  std::vector<Box3d> boxes;
  boxes.reserve(some.size());
  for (const std::uint32_t v : some) boxes.push_back({at[v], at[v]});
  return boxes;
}

/// A part in a frame, up to the level of its slab.
struct BoxStart {
  const Part& part;
  std::vector<Vec3d> at;  ///< by vertex
  const Heights& heights;
  double level = 0;

  /// Of what of a triangle is no higher than the level. The rounding of heights is small against
  /// what the level is above what may be within reach.
  [[nodiscard]] Box3d box(std::uint32_t triangle) const {
    const Triangle& t = part.triangles[triangle];
    Box3d box = empty_box<double>();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t u = t[k], v = t[(k + 1) % 3];
      const double over_u = heights.at(u) - level, over_v = heights.at(v) - level;
      if (over_u <= 0) box.include(at[u]);
      if ((over_u > 0) != (over_v > 0))
        box.include(at[u] + (at[v] - at[u]) * (over_u / (over_u - over_v)));
    }
    return box;
  }

  [[nodiscard]] std::vector<Box3d> boxes(const std::vector<std::uint32_t>& triangles,
                                         double margin) const {
    std::vector<Box3d> all;
    all.reserve(triangles.size());
    for (const std::uint32_t t : triangles) all.push_back(box(t).inflated(margin));
    return all;
  }
};

}  // namespace

IntervalSortedBoxes::IntervalSortedBoxes(const std::vector<Box3d>& boxes,
                                         const std::vector<std::uint32_t>& ids, double margin) {
  Box3d all = empty_box<double>();
  for (const Box3d& box : boxes) all.include(box);
  all = all.inflated(margin);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box3d wider = boxes[i].inflated(margin);
    const int axis = sweep_axis(wider.hi - wider.lo, all);
    by_axis_[static_cast<std::size_t>(axis)].all.push_back({boxes[i], ids[i]});
  }
  for (int axis = 0; axis < 3; ++axis) {
    Sorted& sorted = by_axis_[static_cast<std::size_t>(axis)];
    std::ranges::sort(sorted.all, {},
                      [axis](const Numbered& n) { return std::pair(n.box.lo[axis], n.id); });
    sorted.reached.reserve(sorted.all.size());
    double farthest = -std::numeric_limits<double>::infinity();
    for (const Numbered& n : sorted.all) {
      farthest = std::max(farthest, n.box.hi[axis]);
      sorted.reached.push_back(farthest);
    }
  }
}

struct ProximityBoxes::Framed {
  std::optional<Axes> axes;
  BoxStart a, b;

  Framed(const PairLocalPart& of_a, const PairLocalPart& of_b, const SlabCandidates& facing)
      : axes(axes_that_fit(of_a, of_b, facing)),
        a{of_a.part(), vertices_along(of_a, axes), facing.heights.a, facing.heights.level_a},
        b{of_b.part(), vertices_along(of_b, axes), facing.heights.b, facing.heights.level_b} {}
};

ProximityBoxes::ProximityBoxes(const PairLocalPart& a, const PairLocalPart& b,
                               const SlabCandidates& facing, double reach)
    : ProximityBoxes(Framed(a, b, facing), facing, reach + kFrameRounding) {}

ProximityBoxes::ProximityBoxes(const Framed& framed, const SlabCandidates& facing, double margin)
    : inflated_boxes_(framed.b.boxes(facing.triangles_b, margin)),
      vertices_(boxes_of_vertices(framed.a.at, facing.vertices_a), facing.vertices_a, margin),
      triangles_(framed.a.boxes(facing.triangles_a, 0), facing.triangles_a, margin) {}

}  // namespace strake::geometry
