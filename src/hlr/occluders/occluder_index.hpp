// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "hlr/occluders/projected_shape.hpp"
#include "strake/core/result.hpp"

namespace strake::hlr {

/// Indexes a part of many polygons by buckets or a tree, as the settings ask, and gives a part that
/// runs askew on paper a rotation that fits. Rotation and number of buckets are chosen by `edges`,
/// the part's own; `hubs` are points on paper where many polygons meet. Errors: cancelled.
[[nodiscard]] Status build_occluder_index(const OccluderPolygons& all,
                                          std::span<const ProjectedEdge> edges,
                                          std::vector<PaperCorner> hubs, bool convex,
                                          const ProjectionSettings& settings, OccluderPart& part);

}  // namespace strake::hlr
