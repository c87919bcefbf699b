// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// Simple shapes on the integer grid (micrometres), for the exact tests of closest.hpp,
/// intersect.hpp, separating_axis.hpp and inside.hpp.
///
/// The range in which these are exact: the coordinates of all shapes of one call differ by at most
/// 2^31 units (2.1 km) along each axis, and none is beyond 2^50 units (kMaxGridMm) of the origin.
/// Nothing is decided in floating point alone, and nothing overflows within that range.

/// A segment; its length may be zero.
using Segment = std::array<Vec3l, 2>;

/// Edge i runs from corner i to corner i + 1 (mod 3). A triangle may degenerate to a segment or a
/// point where a test does not say otherwise.
using TriangleCorners = std::array<Vec3l, 3>;

/// How far a straight line through two grid points reaches.
enum class LineKind : std::uint8_t {
  segment,  ///< from the first point to the second
  ray,      ///< from the first point through the second and on
  line,     ///< both ways
};

/// A segment, ray or line; where the two points are one, it is that point.
struct GridLine {
  Vec3l from, to;
  LineKind reach = LineKind::segment;
};

/// The feature of a segment or triangle that a point lies on: bit i is set when corner i is needed
/// to span it. 1, 2, 4 are corners; 3 is a segment's interior or a triangle's edge 0, 6 edge 1, 5
/// edge 2; 7 a triangle's interior; 0 none.
using FeatureMask = std::uint8_t;

/// The feature of a box that a point lies on: bit 2k is set on the face of lo[k], bit 2k + 1 on
/// that of hi[k]. No bit means the interior (or not on the box at all), one a face, two an edge,
/// three a corner; more where the box is flat.
using BoxFeatureMask = std::uint8_t;

}  // namespace strake::geometry
