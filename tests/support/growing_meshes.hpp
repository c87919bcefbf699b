// SPDX-License-Identifier: Apache-2.0
// Meshes of any size that meet many others, for what a pair costs as it grows. Millimetres.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "strake/geometry/vec.hpp"
#include "strake/model/model.hpp"
#include "support/draw.hpp"

namespace strake::test {

/// A survey of hilly ground of 60 m by 60 m in `side` by `side` squares of two triangles each; each
/// survey is up to 60 mm off the ground, another way for each seed.
inline geometry::TriangleMesh terrain_mesh(std::uint32_t side, std::uint64_t seed) {
  constexpr double kSize = 60'000, kNoise = 60;
  Draw draw(seed);
  geometry::TriangleMesh mesh;
  for (std::uint32_t j = 0; j <= side; ++j)
    for (std::uint32_t i = 0; i <= side; ++i) {
      const double x = kSize * i / side, y = kSize * j / side;
      const double ground = 400 * std::sin(x / 7000) + 300 * std::cos(y / 9000);
      mesh.vertices.push_back({x, y, ground + draw.between(-kNoise, kNoise)});
    }
  for (std::uint32_t j = 0; j < side; ++j)
    for (std::uint32_t i = 0; i < side; ++i) {
      const std::uint32_t a = j * (side + 1) + i, b = a + side + 1;
      mesh.triangles.push_back({a, a + 1, b + 1});
      mesh.triangles.push_back({a, b + 1, b});
    }
  return mesh;
}

/// Triangles with corners anywhere in a cube, none of them joined to another.
inline geometry::TriangleMesh scattered_triangles(std::uint32_t count, std::uint64_t seed) {
  constexpr double kSize = 1000;
  Draw draw(seed);
  geometry::TriangleMesh mesh;
  for (std::uint32_t t = 0; t < count; ++t) {
    for (int k = 0; k < 3; ++k)
      mesh.vertices.push_back(
          {draw.between(0, kSize), draw.between(0, kSize), draw.between(0, kSize)});
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return mesh;
}

/// Rings of `sides` corners each, skinned and closed at both ends; ring `i` is at `ring(i)`, which
/// gives its middle and the two half axes.
template <class Ring>
geometry::TriangleMesh swept_mesh(std::uint32_t rings, std::uint32_t sides, const Ring& ring) {
  geometry::TriangleMesh mesh;
  for (std::uint32_t i = 0; i < rings; ++i) {
    const std::array<geometry::Vec3d, 3> at = ring(i);
    for (std::uint32_t k = 0; k < sides; ++k) {
      const double t = 2 * std::numbers::pi * (k + 0.5) / sides;
      mesh.vertices.push_back(at[0] + at[1] * std::cos(t) + at[2] * std::sin(t));
    }
  }
  const std::uint32_t last = (rings - 1) * sides;
  for (std::uint32_t i = 0; i < last; i += sides)
    for (std::uint32_t k = 0; k < sides; ++k) {
      const std::uint32_t a = i + k, b = i + (k + 1) % sides;
      mesh.triangles.push_back({a, b, b + sides});
      mesh.triangles.push_back({a, b + sides, a + sides});
    }
  for (std::uint32_t k = 1; k + 1 < sides; ++k) {
    mesh.triangles.push_back({0, k + 1, k});
    mesh.triangles.push_back({last, last + k, last + k + 1});
  }
  return mesh;
}

/// A coil spring about z of about so many triangles: wire of 80 mm, radius 500 mm, 48 rings and
/// 200 mm a turn.
inline geometry::TriangleMesh coil_mesh(std::uint32_t triangles) {
  constexpr std::uint32_t kSides = 12, kRingsPerTurn = 48;
  constexpr double kRadius = 500, kWire = 40, kPitch = 200;
  return swept_mesh(triangles / (2 * kSides), kSides, [&](std::uint32_t i) {
    const double t = 2 * std::numbers::pi * i / kRingsPerTurn;
    const geometry::Vec3d out{std::cos(t), std::sin(t), 0};
    const geometry::Vec3d along{-kRadius * out.y, kRadius * out.x, kPitch / (2 * std::numbers::pi)};
    const geometry::Vec3d across = cross(out, along);
    const geometry::Vec3d middle =
        out * kRadius + geometry::Vec3d{0, 0, kPitch * i / kRingsPerTurn};
    return std::array{middle, out * kWire, across * (kWire / std::sqrt(dot(across, across)))};
  });
}

/// A flat bar along x that goes up and down: 8 rings and 94 mm a wave.
inline geometry::TriangleMesh corrugated_bar(std::uint32_t triangles, double phase) {
  constexpr std::uint32_t kSides = 4;
  return swept_mesh(triangles / (2 * kSides), kSides, [&](std::uint32_t i) {
    constexpr double kStep = 5, kWave = 15, kHeight = 20;
    const double x = kStep * i;
    return std::array{geometry::Vec3d{x, 0, kHeight * std::sin(x / kWave + phase)},
                      geometry::Vec3d{0, 21, 0}, geometry::Vec3d{0, 0, 10}};
  });
}

/// Bars of 10 mm square and 12 m along 1,1,1 that stand `spacing` apart: number `i` of `count`.
inline geometry::TriangleMesh diagonal_rod(std::uint32_t i, std::uint32_t count, double spacing) {
  constexpr double kLength = 12'000, kWidth = 10;
  const geometry::Vec3d along = geometry::Vec3d{1, 1, 1} * (1 / std::sqrt(3.0));
  const geometry::Vec3d u = geometry::Vec3d{1, -1, 0} * (1 / std::sqrt(2.0)), v = cross(along, u);
  const auto side = static_cast<std::uint32_t>(std::ceil(std::sqrt(count)));
  const geometry::Vec3d at = u * (spacing * (i % side)) + v * (spacing * (i / side));
  return swept_mesh(2, 4, [&](std::uint32_t k) {
    return std::array{at + along * (kLength * k), u * (kWidth / std::sqrt(2.0)),
                      v * (kWidth / std::sqrt(2.0))};
  });
}

}  // namespace strake::test
