// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hlr/feature_edges.hpp"
#include "hlr/frame.hpp"
#include "hlr/view_tree.hpp"
#include "strake/model/scene.hpp"

namespace strake::hlr {

struct Corner {
  std::int64_t u = 0, v = 0;
};

/// A planar convex piece of a surface that hides what lies behind it: a triangle, or exactly
/// coplanar neighbours whose union is convex on paper. Corners run counter-clockwise to the
/// viewer. What it hides is the union of what its triangles hide, ends included.
struct Polygon {
  ViewBox box;
  geometry::Vec3i at;                    ///< a corner
  std::array<std::int64_t, 3> normal{};  ///< to the viewer's side; unused where wide >= 0
  std::int32_t wide = -1;                ///< index into ShapeView::wide_normals
  std::uint32_t first_corner = 0, corners = 0;
  std::uint32_t part = 0;
  /// On the far side of an exactly convex part: an edge below `spare_w` by more than
  /// `spare_per_contact` times the contact distance lies deep enough under every face of the part
  /// for the near side alone to decide (where no limits cut).
  bool far_side = false;
  std::int64_t spare_w = 0;
  double spare_per_contact = 0;
};

/// A feature edge with what the view needs of it.
struct EdgeView {
  FeatureEdge edge;
  ViewPoint a, b;
  /// On a part that is exactly convex: does the part hide its own edge? Neither where unknown.
  bool surely_clear_of_part = false, surely_behind_part = false;
};

/// A shape seen in one direction, shared by all bodies that place it.
struct ShapeView {
  geometry::Vec3l direction;
  std::vector<Corner> corners;
  std::vector<Polygon> polygons;
  std::vector<NormalVector> wide_normals;
  ViewTree tree;           ///< over the polygons, where there are many
  ViewBox box;             ///< of the polygons
  std::int64_t reach = 0;  ///< largest |u| or |v| of a corner
  std::vector<EdgeView> edges;

  [[nodiscard]] NormalVector normal(const Polygon& p) const {
    if (p.wide >= 0) return wide_normals[static_cast<std::size_t>(p.wide)];
    return {p.normal[0], p.normal[1], p.normal[2]};
  }
};

[[nodiscard]] ShapeView view_of(const model::GridShape& shape, const Frame& frame,
                                const FeatureOptions& options);

/// Polygons of one part, appended; true when the part is exactly convex and closed.
bool add_polygons(const geometry::Part& part, std::uint32_t part_index, const Frame& frame,
                  ShapeView& view);

}  // namespace strake::hlr
