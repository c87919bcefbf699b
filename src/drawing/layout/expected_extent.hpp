// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0057 says why curves are as fine as the paper shows.

#include <vector>

#include "drawing/layout/view_plane.hpp"
#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::drawing {

/// The sag that nobody sees, model mm, of curved primitives in a view of that extent and scale:
/// 0.05 mm on paper, a fraction of the finest line's width; no less than the grid can say, and than
/// what is not seen with all of the view on the largest sheet, so that the scale alone makes no
/// drawing endless. Of a view of nothing 0.
[[nodiscard]] double unseen_sag_mm(const PlaneBox& extent, double scale);

/// About the extent that a view has on its plane, before it is drawn, about a point of the model:
/// of the corners of all bodies, `drawn` as in hlr::draw, within the limits and the field of view;
/// of large models, and where limits or sections cut a body, of boxes. Of a view that makes no
/// sense nothing. Errors: cancelled.
[[nodiscard]] Result<PlaneBox> expected_extent(const model::Scene& scene,
                                               const std::vector<bool>& drawn,
                                               const hlr::View& view, const geometry::Vec3l& origin,
                                               const parallel::Context& context);

}  // namespace strake::drawing
