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

/// A box round a part that lies along the part's own faces: tight for what stands askew, where the
/// box along the coordinate axes is not.
///
///     const OrientedBox f = make_oriented_box(x), g = make_oriented_box(y);
///     if (oriented_box_separation({{&x, at_x}, &f}, {{&y, at_y}, &g}, reach) >= reach) ...  //
///     apart for certain
struct OrientedBox {
  std::array<Vec3d, 3> axis;     ///< unit normals of the largest faces; not quite square
  std::array<double, 3> lo, hi;  ///< extent of the vertices along each, grid units
  std::array<Vec3d, 3> edge;     ///< half the edges of a box with right angles round the vertices,
  Vec3d centre;                  ///< and its centre
  SupportTree vertices;          ///< of many, see kManyVertices; else empty
};

/// One pass over the triangles, one over the vertices; of many vertices, a tree. The same with any
/// team or none; of no use where the context's stop token ended it.
[[nodiscard]] OrientedBox make_oriented_box(const Part& part,
                                            const parallel::Context& context = {});

/// Unit vectors at right angles to each other along the axes of a frame, or as near to them as that
/// allows.
[[nodiscard]] std::array<Vec3d, 3> orthonormal_axes(const OrientedBox& frame);
/// Those of a part's frame, of which nothing else is asked.
[[nodiscard]] std::array<Vec3d, 3> orthonormal_axes(const Part& part);

struct PartWithObb {
  PlacedPart placed;
  const OrientedBox* frame = nullptr;
  const TriangleBvh* tree = nullptr;  ///< may be null, or without nodes
};

/// A slab between two parts.
struct SeparationBound {
  /// Grid units, certain: no two points of the parts are nearer. Negative where no slab was found:
  /// moving one by that much parts them.
  double lower = -std::numeric_limits<double>::infinity();
  Vec3d normal;  ///< unit, from b to a: the direction across the slab
};

/// The widest gap between two parts along the axes of either frame. Tells boxes first and looks at
/// vertices only where these leave the gap below `enough` grid units; stops at the first gap of at
/// least that.
[[nodiscard]] SeparationBound oriented_box_separation(const PartWithObb& a, const PartWithObb& b,
                                                      double enough);

}  // namespace strake::geometry
