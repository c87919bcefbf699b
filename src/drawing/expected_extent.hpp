// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "drawing/paper.hpp"
#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::drawing {

/// Of curved primitives, mm on paper: a fraction of the finest line's width.
inline constexpr double kSagOnPaperMm = 0.05;

/// About the extent that a view has on its plane, before it is drawn, about a point of the model:
/// of the corners of all bodies, `drawn` as in hlr::draw, within the limits and the field of view;
/// of large models, and where limits cut a body, of boxes. What sections cut away counts. Of a view
/// without a plane nothing. Errors: cancelled.
[[nodiscard]] Result<PlaneBox> expected_extent(const model::Scene& scene,
                                               const std::vector<bool>& drawn,
                                               const hlr::View& view, const geometry::Vec3l& origin,
                                               const parallel::Context& context);

}  // namespace strake::drawing
