// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "geometry/bvh/pair_local_part.hpp"

namespace strake::geometry {

struct SingleRegionOptions {
  double reach = 0;    ///< grid units
  bool boxed = false;  ///< whether the box of the region is needed
};

/// Whether two parts have few enough triangles for find_single_region() to be quick.
[[nodiscard]] bool is_single_region_affordable(const Part& a, const Part& b);

/// Returns a box if the surfaces of two parts certainly come within reach of each other in one
/// region, without a list of all near triangles: for reaches that are wide compared with the
/// triangles. The box, where needed, is that of all near triangles. Without a result nothing is
/// known: there may be several regions, or none, or the test is not affordable.
///
/// Vertices within reach of each other are united along the edges of either part: the points of an
/// edge within reach of a vertex form an interval. That leaves pairs of triangles that are near,
/// but not at vertices; each has to be connected to others over an edge.
[[nodiscard]] std::optional<Box3d> find_single_region(const PairLocalPart& a,
                                                      const PairLocalPart& b,
                                                      const SingleRegionOptions& options,
                                                      QueryContext& work);

}  // namespace strake::geometry
