// SPDX-License-Identifier: Apache-2.0
#include "pictures/drawn/shade.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pictures/viewpoint/item_buffer.hpp"

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

/// Shades a window band by band: what a band takes stays in the cache of a core.
class Shader {
 public:
  Shader(const Window& window, const NearTriangles& triangles)
      : window_(window), projected_(project_triangles(window, triangles)) {
    const Vec3d lamp = unit(window.axes.toward + window.axes.up * 0.55 - window.axes.right * 0.35);
    colours_.reserve(projected_.size());
    for (const ProjectedTriangle& projected : projected_)
      colours_.push_back(colour_of(triangles[projected.number], projected.back, lamp));
    in_band_.resize((window.rows + kBand - 1) / kBand);
    for (std::uint32_t i = 0; i < projected_.size(); ++i)
      for (std::uint32_t b = projected_[i].first / kBand; b * kBand < projected_[i].end; ++b)
        in_band_[b].push_back(i);
  }

  Shade run() && {
    Shade shade{window_.columns / kFiner, window_.rows / kFiner, {}};
    shade.points.reserve(std::size_t{shade.width} * shade.height);
    for (std::uint32_t b = 0; b < in_band_.size(); ++b) {
      const std::uint32_t first = b * kBand, end = std::min(first + kBand, window_.rows);
      ItemBuffer buffer(window_, first, end);
      buffer.add(projected_, in_band_[b]);
      for (std::uint32_t row = first; row + 1 < end; row += kFiner)
        for (std::uint32_t column = 0; column < window_.columns; column += kFiner)
          shade.points.push_back(mean_at(buffer, column, row));
    }
    return shade;
  }

 private:
  /// Rows of a band, a multiple of kFiner.
  static constexpr std::uint32_t kBand = 64;

  [[nodiscard]] Colour mean_at(const ItemBuffer& buffer, std::uint32_t column,
                               std::uint32_t row) const {
    constexpr Colour kWhite{255, 255, 255};
    unsigned red = 0, green = 0, blue = 0;
    for (std::uint32_t k = 0; k < kFiner * kFiner; ++k) {
      const std::uint32_t triangle = buffer.at(column + k % kFiner, row + k / kFiner).triangle;
      const Colour& one = triangle == ItemBuffer::kNothing ? kWhite : colours_[triangle];
      red += one.red;
      green += one.green;
      blue += one.blue;
    }
    const auto mean = [](unsigned sum) {
      return static_cast<std::uint8_t>(sum / (kFiner * kFiner));
    };
    return {mean(red), mean(green), mean(blue)};
  }

  const Window& window_;
  std::vector<ProjectedTriangle> projected_;
  std::vector<Colour> colours_;
  std::vector<std::vector<std::uint32_t>> in_band_;  ///< numbers of the triangles of each band
};

}  // namespace

Shade shade_of(Window window, const NearTriangles& triangles) {
  window.columns *= kFiner;
  window.rows *= kFiner;
  return Shader(window, triangles).run();
}

}  // namespace strake::pictures
