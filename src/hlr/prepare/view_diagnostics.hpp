// SPDX-License-Identifier: Apache-2.0
// What a user should know of a view: reports on its sections and its eye.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "hlr/prepare/view_job.hpp"
#include "hlr/sections/section_planes.hpp"
#include "hlr/sections/sectioned_shapes.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/model/model.hpp"
#include "strake/model/scene.hpp"

namespace strake::hlr {

/// Returns an object as diagnostics name it: its file and its name, or its id where it has none.
[[nodiscard]] std::string object_text(const model::Model& model, model::ObjectId id);

/// Reports section planes with all that is drawn on one side, and objects that were cut but not
/// closed. Errors: cancelled, out of memory.
[[nodiscard]] Result<Diagnostics> report_sections(const model::Scene& scene,
                                                  const std::vector<bool>& drawn,
                                                  const SectionedShapes& sectioned,
                                                  std::span<const SectionPlane> planes,
                                                  const parallel::Context& context);

/// Reports the objects in whose solids the eye of a view in perspective lies, so that they hide all
/// outside, and those on whose surface it lies, which it does not see. The job must be otherwise
/// ready. Errors: cancelled, out of memory.
[[nodiscard]] Result<Diagnostics> report_eye(const ViewJob& job, const parallel::Context& context);

}  // namespace strake::hlr
