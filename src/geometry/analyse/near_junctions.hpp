// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/analyse/junctions.hpp"
#include "geometry/analyse/near_points.hpp"
#include "geometry/analyse/topology.hpp"
#include "strake/geometry/analyse.hpp"

namespace strake::geometry {

/// Where edges that do not balance are to be cut at corners beside them.
struct NearJunctions {
  EdgeCuts cuts;
  std::vector<std::uint32_t> corners;  ///< that edges are cut at, ascending
  double largest = 0;                  ///< grid units: the farthest of them from its edge
  bool tangled = false;                ///< nothing, as all edges run past all corners
};

/// The T-junctions of a welded mesh whose corner lies within `within` of the edge, and of neither
/// end: a corner is kept where a piece of the edge beside it so matches another that runs back, and
/// no fewer pieces would be left open without it.
/// `may_cut`: per vertex, 1 for corners to cut at, and for ends of edges that may be cut. Nothing
/// where that takes far more than faces of solids would.
[[nodiscard]] NearJunctions near_junctions(const GridMesh& welded, const Topology& topology,
                                           const NearPoints& points,
                                           const std::vector<std::uint8_t>& may_cut,
                                           std::int64_t within);

}  // namespace strake::geometry
