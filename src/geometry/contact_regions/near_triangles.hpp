// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/distance/distance_traversal.hpp"

namespace strake::geometry {

struct NearTriangleOptions {
  double reach = 0;        ///< grid units
  std::uint64_t most = 0;  ///< pairs
};

/// Whether two prepared triangles, with their numbers, are no farther apart than the reach, of
/// which the square is given.
[[nodiscard]] bool triangles_within(const PairLocalPart& a, const PairLocalPart& b,
                                    const DoubleTriangle& of_a, const DoubleTriangle& of_b,
                                    const NodePair& numbers, double squared, QueryContext& work);

/// All pairs of triangles no farther apart than the reach, by (a, b), with certain bounds on their
/// distances, which say no more than that. Nothing where there are too many, or where a sample of
/// the first part's triangles, taken of heavy walks, shows that there are about twice too many:
/// the same for any team. Parts without trees, which should be small, are walked triangle by
/// triangle.
[[nodiscard]] std::optional<std::vector<NearTrianglePair>> near_triangles(
    const PairLocalPart& a, const PairLocalPart& b, const NearTriangleOptions& question,
    QueryContext& work);

/// Makes the bounds of a pair as tight as doubles give them.
void tighten_bounds(const PairLocalPart& a, const PairLocalPart& b, NearTrianglePair& pair);

}  // namespace strake::geometry
