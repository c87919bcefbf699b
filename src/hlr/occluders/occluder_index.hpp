// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "hlr/occluders/projected_shape.hpp"
#include "strake/core/result.hpp"

namespace strake::hlr {

/// Gives a part of many polygons buckets or a tree over them, as the sight asks, and one that runs
/// askew on paper a frame that fits. `edges` are the part's own: what frame and number of buckets
/// are chosen by; `hubs` points on paper round which there are many. Errors: cancelled.
[[nodiscard]] Status build_occluder_index(const OccluderPolygons& all,
                                          std::span<const ProjectedEdge> edges,
                                          std::vector<PaperCorner> hubs, bool convex,
                                          const ProjectionSettings& settings, OccluderPart& part);

}  // namespace strake::hlr
