// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "hlr/edges/feature_edges.hpp"
#include "hlr/edges/slivers.hpp"
#include "strake/geometry/part.hpp"

namespace strake::hlr {

/// Takes out of the edges of a part those smooth ones that run between facets of one curved skin,
/// so that those stay where a curved skin begins or ends.
///
/// Triangles in one plane are one face. Of the two faces at an edge that stays, one reaches more
/// than twice as far away from it as the other, and the edge turns by hardly more than the narrower
/// one does at another smooth edge: a tessellation turns by half a step or one where it leaves a
/// plane, and by one and a half where two of its own facets are as unlike in width. An edge also
/// stays where neither face has another smooth one: a plain fold.
void keep_tangent_edges(const geometry::Part& part, const PlaneOwners& owners,
                        std::vector<FeatureEdge>& edges);

}  // namespace strake::hlr
