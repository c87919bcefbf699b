// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "io/gltf/writer/glb_plan.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/model/model.hpp"

/// Parts of the JSON of a GLB, which every kind of scene has; each function appends its part.
namespace strake::io::gltf {

/// Appends "attributes":{...}; a name that repeats gains a number.
void append_attributes(std::string& out, const model::Attributes& attributes);

/// Appends ,"matrix":[...] of a placement in the file's frame; nothing where it is none.
void append_matrix(std::string& out, const geometry::Placement& placement);

/// Appends ,"NAME":[...]; nothing where there are no nodes.
void append_nodes(std::string& out, std::string_view name, std::span<const std::uint32_t> nodes);

/// Appends a comma but before the first, and ends the line.
void append_separator(std::string& out, bool& first);

/// Appends meshes, materials, accessors, buffer views and the buffer. Buffer view 0 holds
/// positions, then come the 32-bit and the 16-bit indices, as far as there are any, and the blocks.
void append_geometry(std::string& out, const GlbPlan& plan);

}  // namespace strake::io::gltf
