// SPDX-License-Identifier: Apache-2.0
#include "pictures/drawn/shade.hpp"

#include <algorithm>
#include <cmath>

namespace strake::pictures {
namespace {

using geometry::Vec3d;

/// A point of the shade is the mean of so many each way, so that its edges are no stairs.
constexpr std::uint32_t kFiner = 2;

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

Shade shade_of(Window window, std::span<const NearTriangle> triangles) {
  constexpr Colour kWhite{255, 255, 255};
  Shade shade{window.columns, window.rows, {}};
  window.columns *= kFiner;
  window.rows *= kFiner;
  const ItemBuffer buffer(window, triangles);
  const Vec3d lamp = unit(window.axes.toward + window.axes.up * 0.55 - window.axes.right * 0.35);
  const auto colour_at = [&](std::uint32_t column, std::uint32_t row) {
    const ItemBuffer::Item& item = buffer.at(column, row);
    return item.triangle == ItemBuffer::kNothing
               ? kWhite
               : colour_of(triangles[item.triangle], item.back, lamp);
  };
  shade.points.reserve(std::size_t{shade.width} * shade.height);
  for (std::uint32_t row = 0; row < shade.height; ++row)
    for (std::uint32_t column = 0; column < shade.width; ++column) {
      unsigned red = 0, green = 0, blue = 0;
      for (std::uint32_t k = 0; k < kFiner * kFiner; ++k) {
        const Colour one = colour_at(column * kFiner + k % kFiner, row * kFiner + k / kFiner);
        red += one.red;
        green += one.green;
        blue += one.blue;
      }
      const auto mean = [](unsigned sum) {
        return static_cast<std::uint8_t>(sum / (kFiner * kFiner));
      };
      shade.points.push_back({mean(red), mean(green), mean(blue)});
    }
  return shade;
}

}  // namespace strake::pictures
