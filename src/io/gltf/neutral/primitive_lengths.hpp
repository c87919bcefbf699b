// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "strake/geometry/primitive.hpp"

namespace strake::io::gltf {

/// Returns the parameters of a primitive in the order of docs/formats/primitives.md.
[[nodiscard]] std::vector<double> lengths_of(const geometry::Primitive& primitive);

/// Returns the primitive of a kind, as kind_name() spells it, with these parameters; nothing where
/// there is no such kind, or it has another number of them.
[[nodiscard]] std::optional<geometry::Primitive> primitive_of(std::string_view kind,
                                                              std::span<const double> lengths);

}  // namespace strake::io::gltf
