// SPDX-License-Identifier: Apache-2.0
// Judges a drawing point by point in integers: rays from random points of its pieces towards the
// viewer, tested against every triangle near by, by none of the engine's code.
#pragma once

#include <cstdint>
#include <string>

#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"

namespace strake::test {

struct RayCheck {
  std::uint64_t rays = 0;
  std::uint64_t wrong = 0;
  std::uint64_t too_short = 0;  ///< random pieces that were passed over: shorter than 3 grid units
  std::string first_wrong;
};

/// Exact, without any tolerance. A piece's ends are rounded to the grid, so the edge of the mesh
/// that it lies on is looked up and the point is taken on that edge, at a 64th of a grid unit and
/// at least half a unit within the piece. Left and right of the edge are distinguished by the sign
/// of a derivative. The state must be the one that docs/hlr.md defines, contact distance included,
/// hidden_by_self and hidden_by_other distinguished.
///
/// Every second point is of a random piece, every other of a random length of the drawing.
/// Round primitives are those of the view (model::tessellate_for_view), its direction in lowest
/// terms. For whole drawings: no limits, no selection, stage global, within 2^29 grid units (537
/// m).
[[nodiscard]] RayCheck check_by_rays(const model::Scene& scene, const hlr::Drawing& drawing,
                                     std::uint64_t rays, std::uint64_t seed);

}  // namespace strake::test
