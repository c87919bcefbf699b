// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <stop_token>
#include <string>

#include "io/gltf/writer/glb_plan.hpp"
#include "strake/core/result.hpp"
#include "strake/io/writer.hpp"

namespace strake::io::gltf {

/// Hands on a GLB of a JSON text and the geometry of a plan, piece by piece. Errors: output, where
/// it would have more than 4 GiB; cancelled, and then what went to the sink is no GLB.
[[nodiscard]] Status put_glb(ByteSink sink, std::string json, const GlbPlan& plan,
                             const std::stop_token& stop);

/// Writes a GLB of a JSON text and the geometry of a plan, whole or not at all. Errors: output,
/// where it cannot be written or would have more than 4 GiB; cancelled.
[[nodiscard]] Status write_glb_file(const std::filesystem::path& path, std::string json,
                                    const GlbPlan& plan, const std::stop_token& stop);

}  // namespace strake::io::gltf
