// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/near_walk.hpp"

namespace strake::geometry {

struct NearQuestion {
  double reach = 0;        ///< grid units
  std::uint64_t most = 0;  ///< pairs
};

/// Whether two prepared triangles, with their numbers, are no farther apart than the reach, of
/// which the square is given.
[[nodiscard]] bool triangles_within(const PartView& a, const PartView& b,
                                    const DoubleTriangle& of_a, const DoubleTriangle& of_b,
                                    const NodePair& numbers, double squared, PairWork& work);

/// All pairs of triangles no farther apart than the reach, by (a, b), with certain bounds on their
/// distances, which say no more than that. Nothing where there are too many, or where a sample of
/// the first part's triangles, taken of heavy walks, shows that there are about twice too many:
/// the same for any team. Parts without trees, which should be small, are walked triangle by
/// triangle.
[[nodiscard]] std::optional<std::vector<NearTriangles>> near_triangles(const PartView& a,
                                                                       const PartView& b,
                                                                       const NearQuestion& question,
                                                                       PairWork& work);

/// Makes the bounds of a pair as tight as doubles give them.
void sharpen(const PartView& a, const PartView& b, NearTriangles& pair);

}  // namespace strake::geometry
