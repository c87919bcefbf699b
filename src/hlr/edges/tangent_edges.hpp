// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "hlr/edges/feature_edges.hpp"
#include "hlr/edges/slivers.hpp"
#include "strake/geometry/part.hpp"

namespace strake::hlr {

/// Removes from the edges of a part the smooth ones between facets of one curved skin, so that
/// those where a curved skin begins or ends stay.
///
/// Triangles in one plane are one face. Of the two faces at an edge that stays, one reaches more
/// than twice as far from it as the other, and the edge turns by hardly more than the narrower face
/// does at another smooth edge: a tessellation turns by half a step or one step where it leaves a
/// plane, and by one and a half where two of its own facets differ as much in width. An edge also
/// stays where neither face has another smooth edge: a plain fold.
void keep_tangent_edges(const geometry::Part& part, const PlaneOwners& owners,
                        std::vector<FeatureEdge>& edges);

}  // namespace strake::hlr
