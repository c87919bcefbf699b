// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "strake/geometry/part.hpp"

namespace strake::hlr {

/// Half the diagonal of a grid cell: the farthest that the snap moves a corner, grid units.
inline constexpr double kSnapMove = 0.8660254037844386;

/// By how much moves of its corners, by the snap and a weld, may turn a triangle about its longest
/// side, radians: twice what a corner moved by its height above that side. No more than
/// kMostTurn, from which on it counts as a sliver.
[[nodiscard]] double turn_by_rounding(const geometry::Part& part, std::uint32_t triangle);

inline constexpr double kMostTurn = 0.0044;

/// Per triangle the one whose plane it lies in: itself, but for slivers, whose own plane is what
/// rounding made of it. A sliver lies in the plane of a triangle at one of its long sides where
/// none of its corners is farther off that than rounding takes it, or where one beside it does;
/// where nothing is beside it, as on the rim of a foil, it has its own. Empty where all do, and for
/// what is no mesh.
///
/// O(n) for n triangles.
[[nodiscard]] std::vector<std::uint32_t> plane_owners(const geometry::Part& part);

/// Whether the triangle `other` at an edge leaves the plane of the triangle `one` there by more
/// than rounding to the grid may have bent the two. `owners`: of plane_owners().
[[nodiscard]] bool bends(const geometry::Part& part, const std::vector<std::uint32_t>& owners,
                         const geometry::PartEdge& edge, std::uint32_t one, std::uint32_t other);

}  // namespace strake::hlr
