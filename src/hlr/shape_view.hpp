// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hlr/feature_edges.hpp"
#include "hlr/frame.hpp"
#include "hlr/picture.hpp"
#include "hlr/seen_shapes.hpp"
#include "hlr/view_tree.hpp"

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
};

/// A part of a shape as something that hides.
struct PartView {
  ViewBox box;                        ///< of its polygons
  std::int64_t farthest = 0;          ///< least product of a corner with the direction
  std::uint32_t first = 0, last = 0;  ///< its polygons
  ViewTree tree;                      ///< over them, where there are many
  /// Exactly convex: the outline, a polygon without a plane. It hides all that lies under it and
  /// below `farthest` by more than `deep_per_contact` times the contact distance, because that
  /// lies deep enough under whichever face is above.
  bool has_outline = false;
  Polygon outline;
  double deep_per_contact = 0;
};

/// A feature edge with what the view needs of it.
struct EdgeView {
  FeatureEdge edge;
  ViewPoint a, b;  ///< orthographic
  /// On a part that is exactly convex: does the part hide its own edge? Neither where unknown.
  bool surely_clear_of_part = false, surely_behind_part = false;
};

/// How a shape is seen.
struct Sight {
  const Frame& frame;
  FeatureOptions features;           ///< in the coordinates of the shape
  const Picture* picture = nullptr;  ///< null: orthographic
};

/// A shape seen in one direction, shared by all bodies that place it; or in perspective, of one
/// body. Then boxes are those of the picture and hold for the body where it is.
struct ShapeView {
  Viewer viewer;                      ///< in the coordinates of the shape
  std::vector<Corner> corners;        ///< orthographic
  std::vector<geometry::Vec3l> rays;  ///< in perspective: corners relative to the eye
  std::vector<Polygon> polygons;      ///< by part
  std::vector<NormalVector> wide_normals;
  std::vector<PartView> parts;  ///< those that can hide
  ViewBox box;                  ///< of the polygons
  std::int64_t reach = 0;       ///< largest |u| or |v| of a corner
  std::vector<EdgeView> edges;

  [[nodiscard]] NormalVector normal(const Polygon& p) const {
    if (p.wide >= 0) return wide_normals[static_cast<std::size_t>(p.wide)];
    return {p.normal[0], p.normal[1], p.normal[2]};
  }
};

[[nodiscard]] ShapeView view_of(const SeenShape& seen, const Sight& sight);

/// Polygons of one part, appended; true when the part is exactly convex and closed.
bool add_polygons(const geometry::Part& part, std::uint32_t part_index, const Sight& sight,
                  ShapeView& view);

}  // namespace strake::hlr
