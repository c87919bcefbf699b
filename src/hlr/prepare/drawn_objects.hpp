// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"

namespace strake::hlr {

/// Checks that the objects to draw are stated as draw() takes them: one entry each, or none for
/// all. Errors: usage for another number; internal for a scene without a model.
[[nodiscard]] inline Status check_drawn(const model::Scene& scene, const std::vector<bool>& drawn) {
  if (scene.model == nullptr)
    return Error{ErrorCode::internal, "the scene has no model", "view", ""};
  if (!drawn.empty() && drawn.size() != scene.model->objects.size())
    return Error{ErrorCode::usage, "the selection and the model differ in size", "view",
                 "give one entry per object of the scene"};
  return {};
}

}  // namespace strake::hlr
