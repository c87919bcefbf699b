// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::model {

/// A scene as one direction sees it: its round primitives are tessellated anew, so that their
/// contours are edges (geometry::tessellate), once per shape and rotation as in `scene`. All else
/// stays, bodies in their order. `drawn` says which objects are asked for (empty: all); shapes
/// that none of them uses are left empty. Nothing where nothing changes: where no object that is
/// drawn has a round primitive, or the scene was not made by make_scene.
///
/// `towards` points to the viewer, in lowest terms. Applied twice it changes nothing more. The
/// model must outlive the result. Errors: cancelled.
[[nodiscard]] Result<std::optional<Scene>> seen_from(const Scene& scene,
                                                     const std::vector<bool>& drawn,
                                                     const geometry::Vec3l& towards,
                                                     const parallel::Context& context);

}  // namespace strake::model
