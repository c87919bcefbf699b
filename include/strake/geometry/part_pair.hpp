// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "strake/geometry/part.hpp"
#include "strake/geometry/part_tree.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// A part where it stands, with the tree over its triangles.
struct TreedPart {
  PlacedPart placed;
  const PartTree* tree = nullptr;
};

/// How the point sets of two parts meet, decided exactly on the grid. For a solid the set is its
/// closed volume, for a sheet its surface.
enum class Meeting : std::uint8_t {
  apart,       ///< no common point
  touching,    ///< common points, but no interior point of a solid in the other part's interior
               ///< (two sheets: they meet without crossing properly)
  crossing,    ///< interiors meet and the boundaries do too
  a_inside_b,  ///< interiors meet, boundaries share no point, a lies in b
  b_inside_a,
};

/// Refinement of `crossing` and `touching` where the boundaries meet.
struct MeetingResult {
  Meeting meeting = Meeting::apart;
  bool boundaries_meet = false;
  bool a_within_b = false;  ///< closed: no point of a lies outside b (abutting inside, or equal)
  bool b_within_a = false;
  Vec3d point;  ///< a common point, grid units relative to a's origin, if any
  std::uint32_t triangle_a = kNoFace, triangle_b = kNoFace;  ///< where it was found
};

struct PairWork {
  std::uint64_t triangle_pairs = 0, exact_fallbacks = 0, node_pairs = 0;
};

/// Exact: see Meeting. Offsets between the two origins must keep the pair within ±2^30 units of
/// a's origin (the caller checks with fits_pair()).
[[nodiscard]] MeetingResult meet(const TreedPart& a, const TreedPart& b, PairWork& work);

/// True when the offset between the parts, and their extents, fit the exact arithmetic of a pair.
[[nodiscard]] bool fits_pair(const PlacedPart& a, const PlacedPart& b);

/// The closest pair of points of two surfaces.
struct Closest {
  double squared = 0;   ///< grid units², the exact rational rounded to nearest
  double distance = 0;  ///< its square root, rounded
  Vec3d on_a, on_b;     ///< grid units relative to a's origin
  std::uint32_t triangle_a = kNoFace, triangle_b = kNoFace;  ///< lowest ids among exact ties
};

/// The minimum Euclidean distance between the surfaces, if it is below `limit` grid units; the
/// work follows the output, not the gap. Zero when they share a point.
[[nodiscard]] std::optional<Closest> closest(const TreedPart& a, const TreedPart& b, double limit,
                                             PairWork& work);

enum class PointSide : std::uint8_t { outside, on_boundary, inside };

/// Exact side of a rational point: numerator / denominator in grid units relative to the part's
/// origin, denominator in 1..4096.
[[nodiscard]] PointSide side_of(const TreedPart& part, const Vec3l& numerator,
                                std::int64_t denominator, PairWork& work);

/// Distance of a point (grid units relative to the part's origin) to the part's surface.
[[nodiscard]] double distance_to_surface(const TreedPart& part, const Vec3d& point,
                                         double limit = std::numeric_limits<double>::infinity());

}  // namespace strake::geometry
