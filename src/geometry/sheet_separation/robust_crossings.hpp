// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0019 says why displacements tell a touch of sheets from a crossing.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/bvh/pair_local_part.hpp"
#include "geometry/intersect/intersection_segments.hpp"
#include "geometry/numeric/parity_union_find.hpp"
#include "strake/geometry/part_pair.hpp"

// Crossings of two sheets that small displacements do not undo.

namespace strake::geometry {

/// A triangle of one sheet that comes within a distance of the other.
struct PatchTriangle {
  std::uint32_t triangle = 0;
  bool along = false;  ///< it lies along a triangle of the other sheet, or the reverse
  std::uint32_t area = 0;
  bool swapped = false;  ///< oriented against the first triangle of its area
};

/// The areas of one of two sheets that come within a distance of the other: near triangles,
/// connected over edges.
struct ProximityPatches {
  static constexpr std::uint32_t kNone = 0xffffffffU;

  std::vector<PatchTriangle> triangles;  ///< ascending
  std::vector<std::uint32_t> number;  ///< by triangle of the sheet: index in `triangles`, or kNone
  /// By area: whether it has two sides. A Möbius strip has one.
  std::vector<bool> two_sided;

  /// Returns the near triangle with this number; null where it is not near.
  [[nodiscard]] const PatchTriangle* find(std::uint32_t triangle) const {
    const std::uint32_t i = number[triangle];
    return i == kNone ? nullptr : &triangles[i];
  }
};

/// Returns the patches of b, or of a. None where too many triangles are near each other: the work
/// is bounded by a multiple of the number of triangles of the two.
[[nodiscard]] std::optional<ProximityPatches> find_proximity_patches(const PairLocalPart& a,
                                                                     const PairLocalPart& b,
                                                                     bool of_b, double distance,
                                                                     QueryContext& work);

/// Returns the intersection segments of two sheets without those that small displacements undo:
/// displacements of the vertices of one sheet, none longer than `within` grid units, after which no
/// triangle with a displaced vertex crosses the other sheet. (The sheets then swap roles for the
/// rest.) They are sought by area of one sheet within that distance of the other, to either side of
/// it. Whether they separate the sheets is decided exactly, so that crossings by more than `within`
/// are always kept; some others may be.
///
/// `pieces` are find_intersection_segments(a, b, most). The cost is that of some traversals of the
/// contacts where there are areas without a certainly robust segment, and negligible where there
/// are none.
[[nodiscard]] IntersectionSegments keep_robust_segments(const PartWithBvh& a, const PartWithBvh& b,
                                                        IntersectionSegments pieces, double within,
                                                        std::size_t limit, QueryContext& work);

/// Where two sheets cross: segments in grid units relative to a's origin.
struct SheetIntersection {
  std::vector<DoubleSegment> segments;
  std::vector<IntersectionSegment>
      pieces;              ///< by segment: the intersection segment that it is part of
  bool crosses = false;    ///< true even where all segments are too short to list
  bool truncated = false;  ///< the lists may be incomplete
};

/// Returns the segments of find_intersection_segments() that displacements of up to `within` grid
/// units do not undo (keep_robust_segments()): the set is exact, the positions are rounded.
[[nodiscard]] SheetIntersection find_sheet_intersection(const PartWithBvh& a, const PartWithBvh& b,
                                                        double within, std::size_t limit,
                                                        QueryContext& work);

}  // namespace strake::geometry
