// SPDX-License-Identifier: Apache-2.0
// Shapes, parts and edges as a view sees them, and the bodies that place them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hlr/edges/feature_edges.hpp"
#include "hlr/occluders/bucket_grid.hpp"
#include "hlr/occluders/occluder_polygons.hpp"
#include "hlr/occluders/polygon_fan.hpp"
#include "hlr/sections/sectioned_shapes.hpp"
#include "hlr/view/perspective_map.hpp"
#include "hlr/view/projection.hpp"
#include "hlr/view/view_bvh.hpp"
#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// A part of a shape as an occluder.
struct OccluderPart {
  ViewBox box;                        ///< of its polygons
  std::int64_t farthest = 0;          ///< least product of a corner with the direction
  bool edge_on = false;               ///< some of its polygons are, see OccluderPolygon::edge_on
  std::uint32_t first = 0, last = 0;  ///< its polygons
  PaperRotation rotation;             ///< its rotation where the part runs askew on paper
  LooseBox rotated_box;               ///< its box after that rotation
  // Indices over the polygons where there are many: one or neither; after that rotation.
  ViewBvh tree;
  BucketGrid buckets;
  std::vector<PolygonFan> fans;  ///< of polygons that are in neither index
  /// What lies below `farthest` by more than this times the contact distance is deep enough under
  /// whichever face is above. Not for parts without an outline in perspective.
  double deep_per_contact = 0;
  /// For an exactly convex part the outline, a polygon without a plane: it hides all that lies
  /// under it and so deep.
  bool has_outline = false;
  OccluderPolygon outline;
};

/// A feature edge with its projection.
struct ProjectedEdge {
  FeatureEdge edge;
  ViewPoint a, b;  ///< orthographic
  /// For an edge of an exactly convex part: whether the part hides it. Neither where unknown.
  bool surely_clear_of_part = false, surely_behind_part = false;
};

/// How a shape is projected.
struct ProjectionSettings {
  const ViewProjection& projection;
  FeatureOptions features;                          ///< in the coordinates of the shape
  const PerspectiveMap* perspective_map = nullptr;  ///< null: orthographic
  std::int32_t bucketing = Options::kBucketsByData;
  bool find_edge_on = false;       ///< find polygons that may be edge-on but for rounding
  bool hides = true;               ///< make the polygons that hide; the edges alone do without
  parallel::Context context = {};  ///< the team for big shapes
};

/// A shape seen in one direction, shared by all bodies that place it; or in perspective, for one
/// body, with boxes under the PerspectiveMap that hold for the body where it is.
struct ProjectedShape : OccluderPolygons {
  Viewer viewer;                    ///< in the coordinates of the shape
  std::vector<OccluderPart> parts;  ///< the parts that can hide
  ViewBox box;                      ///< box of the polygons
  std::int64_t reach = 0;           ///< largest |u| or |v| of a corner
  std::int64_t farthest = 0;        ///< of its parts, see OccluderPart
  double deep_per_contact = 0;      ///< of its parts; orthographic
  std::vector<ProjectedEdge> edges;
};

/// Projects a shape and makes its edges and, where it hides, its occluders. Errors: cancelled.
[[nodiscard]] Result<ProjectedShape> project_shape(const SectionedShape& sectioned,
                                                   const ProjectionSettings& settings);

/// Appends the polygons of one part; true when the part is exactly convex and closed. `edges` are
/// those of the part: its buckets are chosen by them.
[[nodiscard]] Result<bool> add_polygons(const geometry::Part& part, std::uint32_t part_index,
                                        const ProjectionSettings& settings,
                                        std::span<const ProjectedEdge> edges,
                                        ProjectedShape& shape);

/// A body that places a projected shape, as the solvers use it.
struct BodyInstance {
  const ProjectedShape* shape = nullptr;  ///< null: the body is not drawn
  geometry::Vec3l offset;
  ViewPoint at;
  std::uint32_t object = 0;
  std::int64_t contact = 0;
  std::int64_t within = 0;             ///< contact distance within a part
  bool opaque = false;                 ///< may hide something of what is shown
  bool cut = false;                    ///< the limits cut it
  bool outside = false;                ///< outside of limits or frustum, or cut away: all clipped
  bool forgives_rounding = false;      ///< see ViewJob::forgives_rounding()
  bool shares_self_occlusion = false;  ///< shares it with the other bodies of its shape
  bool repeated = false;               ///< equal bodies at its place hide what it hides
};

}  // namespace strake::hlr
