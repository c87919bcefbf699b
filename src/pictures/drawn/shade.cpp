// SPDX-License-Identifier: Apache-2.0
#include "pictures/drawn/shade.hpp"

#include <algorithm>
#include <cmath>

namespace strake::pictures {
namespace {

using geometry::Vec3d;

/// A colour between white and another; light goes from 0, dark, to 1.
Colour tone(const Colour& colour, double strength, double light) {
  const auto channel = [&](std::uint8_t full) {
    constexpr double kWhite = 255;
    const double tinted = kWhite + (full - kWhite) * strength;
    return static_cast<std::uint8_t>(std::clamp(tinted * light + 0.5, 0.0, kWhite));
  };
  return {channel(colour.red), channel(colour.green), channel(colour.blue)};
}

Vec3d normal_of(const NearTriangle& t) {
  const Vec3d n = cross(t.at[1] - t.at[0], t.at[2] - t.at[0]);
  const double length = std::sqrt(dot(n, n));
  return length > 0 ? n * (1 / length) : n;
}

Colour colour_of(const NearTriangle& triangle, bool back, const Vec3d& lamp) {
  constexpr double kAmbient = 0.72;
  const double light = kAmbient + (1 - kAmbient) * std::fabs(dot(normal_of(triangle), lamp));
  const bool cut = back && triangle.solid;
  switch (triangle.role) {
    case Role::a:
      return cut ? tone(kColourOfA, 0.85, 1) : tone(kColourOfA, 0.5, light);
    case Role::b:
      return cut ? tone(kColourOfB, 0.85, 1) : tone(kColourOfB, 0.5, light);
    case Role::other:
      break;
  }
  constexpr Colour kGrey{0x60, 0x60, 0x60};
  return cut ? tone(kGrey, 0.35, 1) : tone(kGrey, 0.08, 0.35 + 0.65 * light);
}

}  // namespace

Shade shade_of(const Window& window, std::span<const NearTriangle> triangles) {
  constexpr Colour kWhite{255, 255, 255};
  const ItemBuffer buffer(window, triangles);
  const Vec3d lamp = unit(window.axes.toward + window.axes.up * 0.55 - window.axes.right * 0.35);
  Shade shade{window.columns, window.rows, {}};
  shade.points.reserve(std::size_t{window.columns} * window.rows);
  for (std::uint32_t row = 0; row < window.rows; ++row)
    for (std::uint32_t column = 0; column < window.columns; ++column) {
      const ItemBuffer::Item& item = buffer.at(column, row);
      shade.points.push_back(item.triangle == ItemBuffer::kNothing
                                 ? kWhite
                                 : colour_of(triangles[item.triangle], item.back, lamp));
    }
  return shade;
}

}  // namespace strake::pictures
