// SPDX-License-Identifier: Apache-2.0
// Objects that lie so far from all others that they alone decide the scale of a view.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "drawing/layout/view_plane.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/model.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::drawing {

/// Returns the indices of the far ones among boxes on the plane of a view, the farthest first;
/// empty boxes (left > right) take no part.
///
/// The size of a view is the larger of its width and height. Boxes are ordered by how far their
/// farthest side lies from the medians of the middles of all boxes; of equal ones the first comes
/// first. The fewest of that order are far without which the rest are less than 40 % as large,
/// and each of which lies beside the rest, apart from it by at least the rest's size; then the same
/// is asked of the rest. No more are far than the larger of a thousandth of all boxes, and ten or a
/// fifth of them, whichever is less: of fewer than five none is.
[[nodiscard]] std::vector<std::size_t> far_boxes(std::span<const PlaneBox> boxes);

/// What far objects do to a view.
struct FarObjects {
  std::vector<model::ObjectId> objects;  ///< the farthest first; empty: there are none
  PlaneBox whole, rest;                  ///< the expected view with and without them, model mm
  double distance_mm = 0;                ///< on paper from the farthest to the rest, model mm
};

/// Finds the far objects of a view by the boxes of their bodies, `drawn` as in hlr::draw. A view in
/// perspective has none: its field of view bounds it. Errors: usage for a selection of the wrong
/// size; cancelled.
[[nodiscard]] Result<FarObjects> find_far_objects(const model::Scene& scene,
                                                  const std::vector<bool>& drawn,
                                                  const hlr::View& view,
                                                  const parallel::Context& context);

/// Takes the far objects out of a selection as hlr::draw takes it.
void leave_out(const FarObjects& far, const model::Model& model, std::vector<bool>& drawn);

/// Returns which objects lie how far off: "'BOX 7' (a.rvm) lies 3.2 km from the rest", "3 objects,
/// 'BOX 7' (a.rvm) the farthest, lie up to 3.2 km from the rest". There must be some.
[[nodiscard]] std::string far_objects_text(const FarObjects& far, const model::Model& model);

}  // namespace strake::drawing
