// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "io/gltf/accessor.hpp"
#include "io/gltf/json/json.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/model/model.hpp"

namespace strake::io::gltf {

/// The shape of a mesh of a neutral scene, in its own frame.
struct NeutralShape {
  model::Shape shape;
  geometry::Box3d box = geometry::empty_box<double>();  ///< empty for primitives
  std::optional<GltfFault> fault;                       ///< if set, there is no shape
};

/// Reads the shape of a mesh, whose number is for messages.
[[nodiscard]] NeutralShape load_neutral_shape(const Buffers& buffers, const Accessors& accessors,
                                              const JsonValue& mesh, std::size_t index);

/// Returns how many vertices and corners a mesh states; loading its shape reads all of them, used
/// or not, and none of a primitive.
[[nodiscard]] std::uint64_t stated_numbers(const Accessors& accessors, const JsonValue& mesh);

}  // namespace strake::io::gltf
