// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/analytic/pair_side.hpp"
#include "strake/geometry/analytic_pair.hpp"

namespace strake::geometry::analytic {

/// The distance of one body, read about the mesh's origin, and the mesh's triangles: see
/// analytic_gap().
[[nodiscard]] AnalyticGap mesh_gap(const PairSide& side, const TreedPart& mesh, double enough);

}  // namespace strake::geometry::analytic
