// SPDX-License-Identifier: Apache-2.0
// The faces round a line along which parts touch, and whether they join into one flat surface.
#pragma once

#include <cstdint>
#include <span>

#include "strake/geometry/grid_shapes.hpp"

namespace strake::hlr {

/// A triangle with a side along a line that edges of several parts share.
struct SeamFace {
  geometry::TriangleCorners corners{};  ///< outward counter-clockwise for solids; grid units
  std::uint32_t surface = 0;            ///< the part that it belongs to
  bool solid = true;
  std::int64_t contact = 0;  ///< contact distance of its body, grid units
};

/// Returns whether the faces round a line join into one flat surface, or leave none: then the line
/// is a flush seam.
///
/// - Two faces lie in one plane if each corner of one is no farther than the larger contact
///   distance of the two off the plane of the other, the one that reaches farther from the line,
///   in the measure of contact distances, |n·(q - p)| <= contact·|n|₁, and they turn by no more
///   than a degree.
/// - Faces of two solids that lie in one plane, on one side of the line, and look at each other
///   vanish: there the solids touch.
/// - Of the rest there must be none; or two, in one plane on both sides of the line, both of solids
///   that look the same way or both of sheets.
///
/// Not so where a triangle is so narrow that all of it lies within the contact distance of the
/// line.
[[nodiscard]] bool join_flat(const geometry::Segment& line, std::span<const SeamFace> faces);

}  // namespace strake::hlr
