// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0007 says why every part has such a box before anything else is built for it.

#include <array>
#include <limits>

#include "strake/geometry/part.hpp"
#include "strake/geometry/support_tree.hpp"
#include "strake/geometry/triangle_bvh.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/parallel/context.hpp"

namespace strake::geometry {

/// A box round a part along the part's own faces: tight for rotated parts, where the box along the
/// coordinate axes is not.
///
///     const OrientedBox f = make_oriented_box(x), g = make_oriented_box(y);
///     if (oriented_box_separation({{&x, at_x}, &f}, {{&y, at_y}, &g}, reach) >= reach) ...  //
///     apart for certain
struct OrientedBox {
  std::array<Vec3d, 3> axis;     ///< unit normals of the largest faces; not quite perpendicular
  std::array<double, 3> lo, hi;  ///< extent of the vertices along each, grid units
  std::array<Vec3d, 3> edge;     ///< half the edges of a rectangular box round the vertices
  Vec3d centre;                  ///< centre of that box
  SupportTree vertices;          ///< where there are kManyVertices or more; else empty
};

/// Makes the box by one pass over the triangles and one over the vertices, plus a tree over many
/// vertices. The same for any team; unusable where the context's stop token ended the work.
[[nodiscard]] OrientedBox make_oriented_box(const Part& part,
                                            const parallel::Context& context = {});

/// Returns perpendicular unit vectors along the axes of a box, or as near to them as that allows.
[[nodiscard]] std::array<Vec3d, 3> orthonormal_axes(const OrientedBox& frame);
/// Returns the orthonormal axes of a part's oriented box without making the rest of it.
[[nodiscard]] std::array<Vec3d, 3> orthonormal_axes(const Part& part);

struct PartWithObb {
  PlacedPart placed;
  const OrientedBox* frame = nullptr;
  const TriangleBvh* tree = nullptr;  ///< may be null, or without nodes
};

/// A slab between two parts.
struct SeparationBound {
  /// Grid units, certain: no two points of the parts are nearer. Negative where no slab was found:
  /// moving one part by that much separates them.
  double lower = -std::numeric_limits<double>::infinity();
  Vec3d normal;  ///< unit, from b to a: the direction across the slab
};

/// Returns the widest gap between two parts along the axes of either box. Tests boxes first and
/// visits vertices only where the boxes leave the gap below `cutoff` grid units; stops at the first
/// gap of at least that.
[[nodiscard]] SeparationBound oriented_box_separation(const PartWithObb& a, const PartWithObb& b,
                                                      double cutoff);

}  // namespace strake::geometry
