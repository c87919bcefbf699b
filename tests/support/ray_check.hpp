// SPDX-License-Identifier: Apache-2.0
// Judges a drawing point by point: rays from random points of its pieces towards the viewer,
// tested against every triangle near by, by none of the engine's code.
#pragma once

#include <cstdint>
#include <string>

#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"

namespace strake::test {

struct RayCheck {
  std::uint64_t rays = 0;
  std::uint64_t wrong = 0;
  std::string first_wrong;
};

/// A visible point is wrong when some triangle hides it clearly, a hidden one when none comes near
/// to hiding it; "clearly" and "near" allow for the rounding of the pieces to the grid (3 units)
/// and nothing else. For drawings without limits.
[[nodiscard]] RayCheck check_by_rays(const model::Scene& scene, const hlr::Drawing& drawing,
                                     std::uint64_t rays, std::uint64_t seed);

}  // namespace strake::test
