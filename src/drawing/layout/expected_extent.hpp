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

/// Returns the largest sag of curved primitives, model mm, that nobody sees in a view of that
/// extent and scale: 0.05 mm on paper, a fraction of the finest line's width. It is no less than
/// the grid can express, nor than what is not seen with the whole view on the largest sheet, so
/// that the scale alone makes no drawing endless. 0 for an empty view.
[[nodiscard]] double unseen_sag_mm(const PlaneBox& extent, double scale);

/// Estimates the extent that a view will have on its plane, relative to a point of the model: from
/// the corners of all bodies, `drawn` as in hlr::draw, within the limits and the field of view;
/// from boxes in large models and where limits or sections cut a body. An invalid view has an empty
/// extent. Errors: cancelled.
[[nodiscard]] Result<PlaneBox> expected_extent(const model::Scene& scene,
                                               const std::vector<bool>& drawn,
                                               const hlr::View& view, const geometry::Vec3l& origin,
                                               const parallel::Context& context);

/// Returns the box of each object on the plane of a view, about the model's origin: of its bodies'
/// boxes within limits and sections, `drawn` as in hlr::draw. It is empty (left > right) for an
/// object that is not drawn, and for all in an invalid view. Errors: cancelled.
[[nodiscard]] Result<std::vector<PlaneBox>> expected_boxes(const model::Scene& scene,
                                                           const std::vector<bool>& drawn,
                                                           const hlr::View& view,
                                                           const parallel::Context& context);

}  // namespace strake::drawing
