// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/primitive.hpp"

#include <array>

namespace strake::geometry {

bool is_round(const Primitive& primitive) {
  return std::holds_alternative<CylinderPrimitive>(primitive) ||
         std::holds_alternative<SnoutPrimitive>(primitive) ||
         std::holds_alternative<SpherePrimitive>(primitive) ||
         std::holds_alternative<EllipticalDishPrimitive>(primitive) ||
         std::holds_alternative<SphericalDishPrimitive>(primitive) ||
         std::holds_alternative<CircularTorusPrimitive>(primitive);
}

bool is_curved(const Primitive& primitive) {
  return is_round(primitive) || std::holds_alternative<RectangularTorusPrimitive>(primitive);
}

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
