// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "hlr/section_planes.hpp"
#include "hlr/seen_shapes.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/model/scene.hpp"

namespace strake::hlr {

/// What a user should know of the sections of a view: planes with all that is drawn on one side,
/// and objects that were cut but not closed.
[[nodiscard]] Diagnostics report_sections(const model::Scene& scene, const std::vector<bool>& drawn,
                                          const SeenShapes& seen,
                                          std::span<const SectionPlane> planes);

}  // namespace strake::hlr
