// SPDX-License-Identifier: Apache-2.0
#include "geometry/aligned_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/corners.hpp"
#include "geometry/directions.hpp"
#include "geometry/samples.hpp"

namespace strake::geometry {
namespace {

/// Triangles that are looked at, and how many of them have to be needles that run one way.
constexpr std::size_t kSamples = 64, kLeastAlike = 16;
/// A needle is as many times longer than high.
constexpr double kElongation = 6;
/// Cosine of the angle within which needles run one way.
constexpr double kOneWay = 0.9999;
struct Needle {
  Vec3d along, normal;  ///< not unit vectors
};

std::vector<Needle> needles_of(const PartView& view) {
  const std::vector<std::uint32_t>& triangles = view.tree().order();
  const std::size_t count = std::min(triangles.size(), kSamples);
  std::vector<Needle> needles;
  for (std::size_t i = 0; i < count; ++i) {
    const Corners c = as_doubles(view.corners(sample(triangles, i, count)));
    const Needle needle{longest_edge(c), normal_of(c)};
    const double squared = dot(needle.along, needle.along);
    if (squared > kElongation * length(needle.normal)) needles.push_back(needle);
  }
  return needles;
}

bool one_way(const Vec3d& x, const Vec3d& y) {
  const double along = dot(x, y);
  return along * along >= kOneWay * kOneWay * dot(x, x) * dot(y, y);
}

bool along_an_axis(const Vec3d& v) {
  return one_way(v, {1, 0, 0}) || one_way(v, {0, 1, 0}) || one_way(v, {0, 0, 1});
}

/// Along the way that most needles run, the longest of these says it best, and along its normal.
std::optional<Axes> axes_of(const std::vector<Needle>& needles) {
  const Needle* best = nullptr;
  std::size_t most = kLeastAlike - 1;
  for (const Needle& needle : needles) {
    const auto alike = static_cast<std::size_t>(std::ranges::count_if(
        needles, [&](const Needle& other) { return one_way(needle.along, other.along); }));
    const bool longer =
        best != nullptr && dot(needle.along, needle.along) > dot(best->along, best->along);
    if (alike > most || (best != nullptr && alike == most && longer)) {
      most = alike;
      best = &needle;
    }
  }
  if (best == nullptr || along_an_axis(best->along)) return std::nullopt;
  const Vec3d z = best->along * (1 / length(best->along));
  const Vec3d y = cross(z, best->normal * (1 / length(best->normal)));
  const Vec3d unit_y = y * (1 / length(y));
  return Axes{cross(unit_y, z), unit_y, z};
}

}  // namespace

std::optional<AlignedParts> aligned_parts(const PartView& a, const PartView& b,
                                          const parallel::Context& context) {
  auto axes = axes_of(needles_of(a));
  if (!axes) axes = axes_of(needles_of(b));
  if (!axes) return std::nullopt;
  auto of_a = turned_part(a, *axes, context);
  if (!of_a) return std::nullopt;
  auto of_b = turned_part(b, *axes, context);
  if (!of_b) return std::nullopt;
  return AlignedParts{std::move(*of_a), std::move(*of_b)};
}

}  // namespace strake::geometry
