// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "io/gltf/writer/neutral_plan.hpp"
#include "strake/model/model.hpp"

namespace strake::io::gltf {

/// Returns the JSON of a planned model.
[[nodiscard]] std::string neutral_json(const model::Model& model, const NeutralPlan& plan);

}  // namespace strake::io::gltf
