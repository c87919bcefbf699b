// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hlr/buckets.hpp"
#include "hlr/fan.hpp"
#include "hlr/feature_edges.hpp"
#include "hlr/frame.hpp"
#include "hlr/picture.hpp"
#include "hlr/polygon.hpp"
#include "hlr/seen_shapes.hpp"
#include "hlr/turn.hpp"
#include "hlr/view_tree.hpp"
#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// A part of a shape as something that hides.
struct PartView {
  ViewBox box;                        ///< of its polygons
  std::int64_t farthest = 0;          ///< least product of a corner with the direction
  bool edge_on = false;               ///< some of its polygons are, see Polygon::edge_on
  std::uint32_t first = 0, last = 0;  ///< its polygons
  Turn turn;                          ///< where the part runs askew on paper
  LooseBox turned;                    ///< the box in that frame
  // Over them, where there are many: either, or neither; in that frame.
  ViewTree tree;
  Buckets buckets;
  std::vector<Fan> fans;  ///< with polygons that are in neither
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
  std::int32_t bucketing = Options::kBucketsByData;
  bool find_edge_on = false;       ///< tell polygons that may be edge-on but for rounding
  parallel::Context context = {};  ///< for big shapes
};

/// A shape seen in one direction, shared by all bodies that place it; or in perspective, of one
/// body. Then boxes are those of the picture and hold for the body where it is.
struct ShapeView : Polygons {
  Viewer viewer;                ///< in the coordinates of the shape
  std::vector<PartView> parts;  ///< those that can hide
  ViewBox box;                  ///< of the polygons
  std::int64_t reach = 0;       ///< largest |u| or |v| of a corner
  std::vector<EdgeView> edges;
};

/// Errors: cancelled.
[[nodiscard]] Result<ShapeView> view_of(const SeenShape& seen, const Sight& sight);

/// Polygons of one part, appended; true when the part is exactly convex and closed. `edges` are
/// those of the part: what its buckets are chosen by.
[[nodiscard]] Result<bool> add_polygons(const geometry::Part& part, std::uint32_t part_index,
                                        const Sight& sight, std::span<const EdgeView> edges,
                                        ShapeView& view);

}  // namespace strake::hlr
