// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "geometry/bvh/pair_local_part.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/triangle_bvh.hpp"

namespace strake::geometry {

/// Some of a part's triangles, with a tree of their own.
struct SlabPiece {
  const Part* part = nullptr;
  TriangleBvh tree;

  /// In the coordinates of a pair; the triangles keep their numbers.
  [[nodiscard]] PairLocalPart view(const Vec3l& shift) const {
    return {PartWithBvh{{part, {}}, &tree}, shift};
  }
};

/// Two parts cut into their flat levels square to a common direction, a few grid units high and of
/// many triangles each, and a piece with all the rest. Boxes of needles that fan out from one
/// corner overlap each other by the square of their number, so that no tree over a whole part tells
/// two flat faces from each other; their heights do.
struct SlabPartition {
  struct Pair {
    const SlabPiece *a = nullptr, *b = nullptr;
    double gap = 0;  ///< they are so far apart by their heights; negative where those overlap
  };

  std::vector<SlabPiece> a, b;
  std::vector<Pair> open;  ///< that their heights do not part, nearest first
  double gap = std::numeric_limits<double>::infinity();  ///< all other pairs are so far apart
};

struct SlabOptions {
  double apart = 0;  ///< grid units: what is so far apart for certain counts as parted
  std::optional<Vec3d> hint = {};  ///< a direction to try first
  bool whatever_is_left = false;   ///< the pieces are wanted even where they part next to nothing
};

/// The pieces of two parts. Nothing where no direction parts a good share of the triangles; parts
/// without flat faces are told by a few samples. O(n log n).
///
/// A direction is the mean normal of all triangles that look along a rough one, within a few
/// degrees and what the snap may have turned them by, weighed by their areas: a fan has a normal
/// that none of its snapped needles has.
[[nodiscard]] std::optional<SlabPartition> partition_by_height(const PairLocalPart& a,
                                                               const PairLocalPart& b,
                                                               const SlabOptions& question);

}  // namespace strake::geometry
