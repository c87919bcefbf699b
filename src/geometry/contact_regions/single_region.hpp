// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "geometry/bvh/pair_local_part.hpp"

namespace strake::geometry {

struct SingleRegionOptions {
  double reach = 0;    ///< grid units
  bool boxed = false;  ///< whether the box of the place is asked for
};

/// Whether two parts have few enough triangles for find_single_region() to be quick.
[[nodiscard]] bool is_single_region_affordable(const Part& a, const Part& b);

/// Whether the skins of two parts certainly come within reach of each other in one place, without a
/// list of all near triangles: for reaches that are wide against the triangles. The box that holds
/// the place, where asked for, is that of all near triangles. Nothing says nothing: there may be
/// several places, or none, or it is not affordable.
///
/// Corners that are within reach of each other are joined along the edges of either part: of the
/// points of an edge those within reach of a corner are a stretch. That leaves pairs of triangles
/// that are near, but not at corners; each has to hang together with others over an edge.
[[nodiscard]] std::optional<Box3d> find_single_region(const PairLocalPart& a,
                                                      const PairLocalPart& b,
                                                      const SingleRegionOptions& question,
                                                      QueryContext& work);

}  // namespace strake::geometry
