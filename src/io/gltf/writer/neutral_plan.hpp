// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0075 says why it is a GLB, and what it has beside what viewers show.

#include <cstdint>
#include <vector>

#include "io/gltf/writer/glb_plan.hpp"
#include "strake/core/result.hpp"
#include "strake/io/writer.hpp"
#include "strake/model/model.hpp"

namespace strake::io::gltf {

/// A model as a GLB from which it is read again as it was (docs/formats/gltf.md). Each mesh is what
/// viewers show of one shape in one colour; its extras say what the shape is, where that is more.
struct NeutralPlan {
  GlbPlan glb;
  std::vector<std::uint32_t> meshes;  ///< per body; kNoMesh: there is nothing of it
};

/// Errors: output, for what is not finite or has no place in float32.
[[nodiscard]] Result<NeutralPlan> plan_neutral(const model::Model& model,
                                               const WriteOptions& options);

}  // namespace strake::io::gltf
