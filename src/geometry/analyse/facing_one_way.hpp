// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "geometry/analyse/topology.hpp"
#include "strake/geometry/analyse.hpp"

namespace strake::geometry {

/// Closed surfaces of which some triangles face the other way than the rest: turns those, the fewer
/// ones, and returns how many. Only surfaces of which each edge has two triangles and that have two
/// sides; of as many either way the lowest stays. The order of weld_triangles() holds, the topology
/// has to be made anew. Linear.
[[nodiscard]] std::uint64_t turn_to_face_one_way(GridMesh& welded, const Topology& topology);

}  // namespace strake::geometry
