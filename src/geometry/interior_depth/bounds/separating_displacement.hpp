// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0021 says why vertices are moved before the linear programs.

#include <cstdint>
#include <optional>
#include <vector>

#include "strake/geometry/part_pair.hpp"

namespace strake::geometry {

/// Two solids that all but touch.
struct SeparatingDisplacement {
  double depth = 0;  ///< grid units: no point of both is farther than this from either skin
  /// The corners of triangles that come so near to the other, ascending.
  std::vector<std::uint32_t> corners_a, corners_b;
};

/// Bounds the depth of two solids by moves of their corners, none longer than `first` grid units
/// (at least 1) or, where these do not do, than `most`: each body in turn shrinks where it comes
/// near the other. Where the moved skin of one has no point in common with the other, and neither
/// is inside the other, the interiors have none either; what they had in common was passed by the
/// skin on its way, so that it is no farther from the skin than that moved. Decided exactly.
///
/// Nothing where such moves are not found: bodies that are deeper in each other end at the first
/// triangles that show it. The pair fits the exact arithmetic (fits_pair()).
[[nodiscard]] std::optional<SeparatingDisplacement> find_separating_displacement(
    const PartWithBvh& a, const PartWithBvh& b, double first, double most, QueryContext& work);

}  // namespace strake::geometry
