// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/distance/distance_traversal.hpp"

namespace strake::geometry {

struct NearTriangleOptions {
  double reach = 0;         ///< grid units
  std::uint64_t limit = 0;  ///< pairs
};

/// Whether two prepared triangles, given with their numbers, are no farther apart than the reach,
/// whose square is given.
[[nodiscard]] bool triangles_within(const PairLocalPart& a, const PairLocalPart& b,
                                    const DoubleTriangle& of_a, const DoubleTriangle& of_b,
                                    const NodePair& numbers, double squared, QueryContext& work);

/// Returns all pairs of triangles no farther apart than the reach, sorted by (a, b), with certain
/// but loose bounds on their distances. Nothing where there are too many, or where a sample of the
/// first part's triangles, taken in heavy traversals, shows about twice too many: the same for any
/// team. Parts without trees, which should be small, are scanned triangle by triangle.
[[nodiscard]] std::optional<std::vector<NearTrianglePair>> near_triangles(
    const PairLocalPart& a, const PairLocalPart& b, const NearTriangleOptions& options,
    QueryContext& work);

/// Tightens the bounds of a pair to the precision of doubles.
void tighten_bounds(const PairLocalPart& a, const PairLocalPart& b, NearTrianglePair& pair);

}  // namespace strake::geometry
