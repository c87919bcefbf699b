// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "io/gltf/accessor.hpp"
#include "io/gltf/json/json.hpp"

namespace strake::io::gltf {

/// The features of EXT_mesh_features that a mesh is.
struct MeshFeatures {
  /// Rows of tables: those of the sets by which all of the mesh is one feature.
  std::vector<std::pair<std::uint64_t, std::uint64_t>> rows;
  bool several = false;  ///< by another set parts of the mesh are different ones
};

/// Reads the ids of `left` vertices at most, and takes those that it read off it: many
/// meshes may name the same ones.
[[nodiscard]] MeshFeatures features_of(const JsonValue& mesh, const Accessors& accessors,
                                       std::uint64_t& left);

}  // namespace strake::io::gltf
