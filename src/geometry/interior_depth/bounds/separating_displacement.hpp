// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0021 says why vertices are moved before the linear programs.

#include <cstdint>
#include <optional>
#include <vector>

#include "strake/geometry/part_pair.hpp"

namespace strake::geometry {

/// Displacements that separate two solids which overlap only slightly.
struct SeparatingDisplacement {
  double depth = 0;  ///< grid units: no point of both is farther than this from either surface
  /// The vertices of triangles that come so near to the other part, ascending.
  std::vector<std::uint32_t> corners_a, corners_b;
};

/// Bounds the depth of two solids by displacements of their vertices, none longer than `first` grid
/// units (at least 1) or, where these do not suffice, than `limit`: each body in turn shrinks where
/// it comes near the other. Where the displaced surface of one has no point in common with the
/// other, and neither is inside the other, the interiors have none either; the surface swept over
/// the former intersection, which therefore is no farther from it than it moved. Decided exactly.
///
/// Nothing where no such displacements are found: for deeper bodies the search ends at the first
/// triangles that show it. The pair fits the exact arithmetic (fits_pair()).
[[nodiscard]] std::optional<SeparatingDisplacement> find_separating_displacement(
    const PartWithBvh& a, const PartWithBvh& b, double first, double limit, QueryContext& work);

}  // namespace strake::geometry
