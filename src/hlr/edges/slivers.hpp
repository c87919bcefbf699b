// SPDX-License-Identifier: Apache-2.0
// Slivers: triangles so narrow that rounding may have turned them, and the planes they lie in.
#pragma once

// Decision 0056 says why slivers have no plane of their own.

#include <cstdint>
#include <vector>

#include "strake/geometry/part.hpp"

namespace strake::hlr {

/// Returns by how much the snap and a weld may turn a triangle about its longest side, radians:
/// twice the move of a corner by its height above that side. The result is a quarter of a degree at
/// most, from which on a triangle counts as a sliver, whose turn is unknown.
[[nodiscard]] double turn_by_rounding(const geometry::Part& part, std::uint32_t triangle);

/// For each triangle the one whose plane it lies in: itself, except for slivers, whose own plane is
/// a product of rounding.
struct PlaneOwners {
  std::vector<std::uint32_t> of;     ///< empty: each lies in its own plane
  std::vector<std::uint8_t> turned;  ///< whether it is wound the other way round than its owner

  [[nodiscard]] std::uint32_t owner(std::uint32_t triangle) const {
    return of.empty() ? triangle : of[triangle];
  }
};

/// Finds the owners. A sliver lies in the plane of a triangle beyond one of its long sides, or in
/// that of a sliver there, where none of its corners is farther off that plane than rounding takes
/// it: two units and the weld, Euclidean distance. Where there is no such plane, as on the rim of a
/// foil, it lies in its own. Primitives have no slivers.
///
/// Cost: O(n log n) for n triangles.
[[nodiscard]] PlaneOwners plane_owners(const geometry::Part& part);

/// Returns whether the triangle `other` at an edge leaves the plane of the triangle `one` there by
/// more than rounding to the grid may have bent the two.
[[nodiscard]] bool bends(const geometry::Part& part, const PlaneOwners& owners,
                         const geometry::PartEdge& edge, std::uint32_t one, std::uint32_t other);

}  // namespace strake::hlr
