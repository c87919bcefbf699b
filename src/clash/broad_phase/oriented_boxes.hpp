// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0041 says when boxes along the faces come in.

#include "clash/broad_phase/broad_phase.hpp"
#include "geometry/bvh/scene_bvh.hpp"

namespace strake::clash {

/// Makes boxes along their own faces for rotated parts, inflated as inflated_box() does, in a frame
/// that parts share where that is as tight for all of them. There is no frame but the first where
/// no part is rotated. Errors: cancelled.
[[nodiscard]] Result<geometry::BoxesInFrames> make_oriented_boxes(const ScenePartList& list,
                                                                  const SearchReach& reach,
                                                                  const parallel::Context& context);

}  // namespace strake::clash
