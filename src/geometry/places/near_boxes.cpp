// SPDX-License-Identifier: Apache-2.0
#include "geometry/places/near_boxes.hpp"

#include <limits>
#include <optional>

#include "geometry/aligned_parts.hpp"
#include "geometry/box.hpp"
#include "geometry/heights.hpp"
#include "geometry/sweep_axis.hpp"

namespace strake::geometry {
namespace {

/// Pairs of triangles that face each other, for each triangle of the two parts, above which a frame
/// costs less than what boxes along the coordinate axes may leave.
constexpr std::size_t kManyFacing = 32;

std::optional<Axes> axes_that_fit(const PartView& a, const PartView& b, const Facing& facing) {
  const std::size_t triangles = a.part().triangles.size() + b.part().triangles.size();
  const bool many = facing.triangles_a.size() * facing.triangles_b.size() > kManyFacing * triangles;
  if (!many || !a.planted() || !b.planted()) return std::nullopt;
  return needle_axes(a, b);
}

std::vector<Vec3d> vertices_along(const PartView& view, const std::optional<Axes>& axes) {
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

/// A part in a frame, as high as it matters.
struct Low {
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

SortedBoxes::SortedBoxes(const std::vector<Box3d>& boxes, const std::vector<std::uint32_t>& ids,
                         double margin) {
  Box3d all = empty_box<double>();
  for (const Box3d& box : boxes) all.include(box);
  all = all.inflated(margin);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box3d wider = boxes[i].inflated(margin);
    const int axis = best_axis(wider.hi - wider.lo, all);
    by_axis_[static_cast<std::size_t>(axis)].all.push_back({boxes[i], ids[i]});
  }
  for (int axis = 0; axis < 3; ++axis) {
    Sorted& sorted = by_axis_[static_cast<std::size_t>(axis)];
    std::ranges::sort(sorted.all, {}, [axis](const Numbered& n) { return n.box.lo[axis]; });
    sorted.reached.reserve(sorted.all.size());
    double farthest = -std::numeric_limits<double>::infinity();
    for (const Numbered& n : sorted.all) {
      farthest = std::max(farthest, n.box.hi[axis]);
      sorted.reached.push_back(farthest);
    }
  }
}

struct NearBoxes::Framed {
  std::optional<Axes> axes;
  Low a, b;

  Framed(const PartView& of_a, const PartView& of_b, const Facing& facing)
      : axes(axes_that_fit(of_a, of_b, facing)),
        a{of_a.part(), vertices_along(of_a, axes), facing.heights.a, facing.heights.level_a},
        b{of_b.part(), vertices_along(of_b, axes), facing.heights.b, facing.heights.level_b} {}
};

NearBoxes::NearBoxes(const PartView& a, const PartView& b, const Facing& facing, double reach)
    : NearBoxes(Framed(a, b, facing), facing, reach + kFrameRounding) {}

NearBoxes::NearBoxes(const Framed& framed, const Facing& facing, double margin)
    : rooms_(framed.b.boxes(facing.triangles_b, margin)),
      vertices_(boxes_of_vertices(framed.a.at, facing.vertices_a), facing.vertices_a, margin),
      triangles_(framed.a.boxes(facing.triangles_a, 0), facing.triangles_a, margin) {}

}  // namespace strake::geometry
