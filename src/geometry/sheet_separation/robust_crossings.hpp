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

namespace strake::geometry {

/// A triangle of one sheet that comes within a distance of the other.
struct PatchTriangle {
  std::uint32_t triangle = 0;
  bool along = false;  ///< it lies along one of the other's, or one of them along it
  std::uint32_t area = 0;
  bool swapped = false;  ///< its outer side is the inner side of the first triangle of its area
};

/// The areas of one of two sheets that come within a distance of the other: near triangles, joined
/// over edges.
struct ProximityPatches {
  static constexpr std::uint32_t kNone = 0xffffffffU;

  std::vector<PatchTriangle> triangles;  ///< ascending
  std::vector<std::uint32_t> number;  ///< by triangle of the sheet: place in `triangles`, or kNone
  /// By area: has two sides. What closes to a Möbius strip has one.
  std::vector<bool> two_sided;

  /// Null where the triangle is not near.
  [[nodiscard]] const PatchTriangle* find(std::uint32_t triangle) const {
    const std::uint32_t i = number[triangle];
    return i == kNone ? nullptr : &triangles[i];
  }
};

/// Those of b, or of a. None where the triangles that are near each other are too many to look at:
/// the work is bounded by a multiple of the number of triangles of the two.
[[nodiscard]] std::optional<ProximityPatches> find_proximity_patches(const PairLocalPart& a,
                                                                     const PairLocalPart& b,
                                                                     bool of_b, double distance,
                                                                     QueryContext& work);

/// The crossing pieces of two sheets but for those that small moves undo: moves of the corners of
/// one of the sheets, none longer than `within` grid units, after which no triangle with a corner
/// that was moved crosses the other sheet. (The other way round for what is left then.) Such moves
/// are looked for by area that one sheet has within that distance of the other, to either side of
/// it. Whether they part the sheets is decided exactly, so that what crosses by more than `within`
/// is always kept; of what does not, some may be.
///
/// `pieces` are find_intersection_segments(a, b, most). The cost is that of some walks over the
/// contacts where there are areas of which no piece certainly lasts, nothing worth mentioning where
/// there are none.
[[nodiscard]] IntersectionSegments keep_robust_segments(const PartWithBvh& a, const PartWithBvh& b,
                                                        IntersectionSegments pieces, double within,
                                                        std::size_t most, QueryContext& work);

/// Where two sheets cross: segments in grid units relative to a's origin.
struct SheetIntersection {
  std::vector<DoubleSegment> segments;
  std::vector<IntersectionSegment> pieces;  ///< by segment: what it is part of
  bool crosses = false;                     ///< though it may be in segments too short to tell
  bool truncated = false;                   ///< there may be more
};

/// The segments of find_intersection_segments() that moves of up to `within` grid units do not undo
/// (keep_robust_segments()): which these are is exact, where they lie is rounded.
[[nodiscard]] SheetIntersection find_sheet_intersection(const PartWithBvh& a, const PartWithBvh& b,
                                                        double within, std::size_t most,
                                                        QueryContext& work);

}  // namespace strake::geometry
