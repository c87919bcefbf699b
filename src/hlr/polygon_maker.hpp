// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "hlr/loops.hpp"
#include "hlr/picture.hpp"
#include "hlr/polygon.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// Makes polygons of the triangles of a part, for one worker; it keeps its memory.
class PolygonMaker {
 public:
  /// `picture`: null where the view is orthographic.
  PolygonMaker(const PartSight& seen, std::uint32_t part_index, const Picture* picture)
      : seen_(seen), part_index_(part_index), picture_(picture), loops_(seen) {}

  /// Coplanar triangles that look the same way and all, or none, may be edge-on: one polygon if
  /// that is convex, or each.
  void add_group(std::span<const std::uint32_t> triangles, Polygons& out);
  /// A triangle of a part that is too wide for narrow normals, unless it is seen edge-on.
  void add_wide(std::uint32_t triangle, Polygons& out);
  /// The outline of a certified convex part: corners are appended, the polygon is filled. False
  /// where it is not one convex loop.
  [[nodiscard]] bool make_outline(Polygon& outline, Polygons& out);

 private:
  Polygon& start(std::uint32_t vertex, Polygons& out) const;
  void add_found(std::uint32_t triangle, Polygons& out);
  void add_corners(Polygon& p, std::span<const std::uint32_t> vertices, Polygons& out) const;

  const PartSight& seen_;
  std::uint32_t part_index_;
  const Picture* picture_;
  Loops loops_;
};

/// Appends what was made run by run, none of it by add_wide. Errors: cancelled.
[[nodiscard]] Status append(Polygons& all, std::span<const Polygons> runs,
                            const parallel::Context& context);

}  // namespace strake::hlr
