// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0056 says why slivers have no plane of their own.

#include <cstdint>
#include <vector>

#include "strake/geometry/part.hpp"

namespace strake::hlr {

/// By how much moves of its corners, by the snap and a weld, may turn a triangle about its longest
/// side, radians: twice what a corner moved by its height above that side. Of slivers nothing is
/// known: no more than a quarter of a degree, from which on a triangle counts as one.
[[nodiscard]] double turn_by_rounding(const geometry::Part& part, std::uint32_t triangle);

/// Per triangle the one whose plane it lies in: itself, but for slivers, whose own plane is what
/// rounding made of it.
struct PlaneOwners {
  std::vector<std::uint32_t> of;     ///< empty: each lies in its own
  std::vector<std::uint8_t> turned;  ///< whether it is wound the other way than its owner

  [[nodiscard]] std::uint32_t owner(std::uint32_t triangle) const {
    return of.empty() ? triangle : of[triangle];
  }
};

/// A sliver lies in the plane of a triangle beyond one of its long sides, or in the plane that a
/// sliver there lies in, where none of its corners is farther off that plane than rounding takes
/// it: two units and the weld, as the crow flies. Where there is none, as on the rim of a foil, it
/// lies in its own. Primitives have no slivers.
///
/// O(n log n) for n triangles.
[[nodiscard]] PlaneOwners plane_owners(const geometry::Part& part);

/// Whether the triangle `other` at an edge leaves the plane of the triangle `one` there by more
/// than rounding to the grid may have bent the two.
[[nodiscard]] bool bends(const geometry::Part& part, const PlaneOwners& owners,
                         const geometry::PartEdge& edge, std::uint32_t one, std::uint32_t other);

}  // namespace strake::hlr
