// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "clash/broad_phase/broad_phase.hpp"

namespace strake::clash {

/// Returns by how much the volume that two solids have in common may differ from that of their
/// triangles, since tessellation, welds and the snap leave their surfaces where they are to within
/// a bound: no more than the volume within that bound of either surface near the other body. Cubic
/// grid units; 0 where the triangles are exact.
[[nodiscard]] double volume_uncertainty(const ScenePart& a, const ScenePart& b);

}  // namespace strake::clash
