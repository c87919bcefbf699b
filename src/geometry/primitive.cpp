// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/primitive.hpp"

#include <array>

namespace strake::geometry {

std::string_view kind_name(const Primitive& primitive) {
  static constexpr std::array<std::string_view, std::variant_size_v<Primitive>> kNames{
      "box",
      "pyramid",
      "cylinder",
      "snout",
      "sphere",
      "elliptical_dish",
      "spherical_dish",
      "circular_torus",
      "rectangular_torus",
      "line"};
  return kNames[primitive.index()];
}

}  // namespace strake::geometry
