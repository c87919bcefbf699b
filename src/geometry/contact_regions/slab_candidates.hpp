// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/bvh/pair_local_part.hpp"
#include "geometry/distance/slab_proximity.hpp"
#include "strake/geometry/vec.hpp"

// Candidates for proximity by the slab between two parts, and boxes over them.

namespace strake::geometry {

/// The features of two parts that may be within reach of the other, by a slab between them: few for
/// bodies that touch along flat faces, all for others.
struct SlabCandidates {
  SlabHeights heights;
  std::vector<std::uint32_t> triangles_a = {}, triangles_b = {};  ///< ascending
  std::vector<std::uint32_t> vertices_a = {};                     ///< of triangles_a, ascending
  std::vector<std::uint32_t> edges_a = {};  ///< between two of these, ascending
};

/// Returns the heights of two parts over the slab between their hulls. `reach`: grid units.
[[nodiscard]] SlabHeights project_on_slab_axis(const PairLocalPart& a, const PairLocalPart& b,
                                               double reach);

/// Returns the candidates within `reach` grid units. Scans all vertices and triangles.
[[nodiscard]] SlabCandidates facing(const PairLocalPart& a, const PairLocalPart& b, double reach);

/// Numbered boxes, sorted by their lower ends: each along the axis that separates it best from the
/// others.
class IntervalSortedBoxes {
 public:
  /// Box i has number ids[i]; query boxes are wider by a margin on each side.
  IntervalSortedBoxes(const std::vector<Box3d>& boxes, const std::vector<std::uint32_t>& ids,
                      double margin);

  /// Calls `visit(id)` for the boxes that overlap a box, in no order.
  template <class Visit>
  void for_each_overlapping(const Box3d& box, const Visit& visit) const {
    for (int axis = 0; axis < 3; ++axis) {
      const auto& [all, reached] = by_axis_[static_cast<std::size_t>(axis)];
      const auto first = std::ranges::lower_bound(reached, box.lo[axis]) - reached.begin();
      for (auto i = static_cast<std::size_t>(first); i < all.size(); ++i) {
        if (all[i].box.lo[axis] > box.hi[axis]) break;
        if (all[i].box.meets(box)) visit(all[i].id);
      }
    }
  }

 private:
  struct Numbered {
    Box3d box;
    std::uint32_t id = 0;
  };
  struct Sorted {
    std::vector<Numbered> all;
    std::vector<double> reached;  ///< how far the boxes up to each reach along the axis
  };

  std::array<Sorted, 3> by_axis_;
};

/// Finds the features of the first part that may be within reach of a triangle of the second, by
/// the boxes of the candidates: along the parts' slivers where many triangles face each other, else
/// along the coordinate axes.
class ProximityBoxes {
 public:
  /// `reach`: grid units.
  ProximityBoxes(const PairLocalPart& a, const PairLocalPart& b, const SlabCandidates& facing,
                 double reach);

  /// Calls `visit(vertex)` for some of facing.vertices_a, in no order, among them those within
  /// reach of the triangle at position `of_b` of facing.triangles_b.
  template <class Visit>
  void vertices_near(std::size_t of_b, const Visit& visit) const {
    vertices_.for_each_overlapping(inflated_boxes_[of_b], visit);
  }
  /// Calls `visit(triangle)` for some of facing.triangles_a, likewise.
  template <class Visit>
  void triangles_near(std::size_t of_b, const Visit& visit) const {
    triangles_.for_each_overlapping(inflated_boxes_[of_b], visit);
  }

 private:
  /// The parts in a frame.
  struct Framed;
  ProximityBoxes(const Framed& framed, const SlabCandidates& facing, double margin);

  std::vector<Box3d> inflated_boxes_;  ///< by position in facing.triangles_b
  IntervalSortedBoxes vertices_, triangles_;
};

}  // namespace strake::geometry
