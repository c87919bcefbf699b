// SPDX-License-Identifier: Apache-2.0
// Finely tessellated closed bodies for tests and benchmarks, in millimetres.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>

#include "strake/geometry/mesh.hpp"

namespace strake::test {

/// A closed surface round z: `rings` bands of `sectors` quads between two poles. `point` gives the
/// place at (ring / rings, angle); all points of ring 0 and of the last ring must agree.
inline geometry::TriangleMesh revolved(
    std::uint32_t rings, std::uint32_t sectors,
    const std::function<geometry::Vec3d(double, double)>& point) {
  geometry::TriangleMesh m;
  m.vertices.push_back(point(0, 0));
  for (std::uint32_t r = 1; r < rings; ++r)
    for (std::uint32_t s = 0; s < sectors; ++s)
      m.vertices.push_back(
          point(static_cast<double>(r) / rings, 2 * std::numbers::pi * s / sectors));
  m.vertices.push_back(point(1, 0));
  const auto top = static_cast<std::uint32_t>(m.vertices.size() - 1);
  const auto at = [&](std::uint32_t r, std::uint32_t s) {
    return 1 + (r - 1) * sectors + s % sectors;
  };
  for (std::uint32_t s = 0; s < sectors; ++s) {
    m.triangles.push_back({0, at(1, s + 1), at(1, s)});
    for (std::uint32_t r = 1; r + 1 < rings; ++r) {
      m.triangles.push_back({at(r, s), at(r, s + 1), at(r + 1, s + 1)});
      m.triangles.push_back({at(r, s), at(r + 1, s + 1), at(r + 1, s)});
    }
    m.triangles.push_back({at(rings - 1, s), at(rings - 1, s + 1), top});
  }
  return m;
}

/// About 4·rings² triangles with their corners on the sphere.
inline geometry::TriangleMesh sphere_mesh(double radius, std::uint32_t rings) {
  return revolved(rings, 2 * rings, [&](double t, double angle) {
    const double tilt = std::numbers::pi * (t - 0.5), r = radius * std::cos(tilt);
    const bool pole = t <= 0 || t >= 1;
    return geometry::Vec3d{pole ? 0 : r * std::cos(angle), pole ? 0 : r * std::sin(angle),
                           radius * std::sin(tilt)};
  });
}

/// A sphere with `waves` hills and dales along either way: far from convex.
inline geometry::TriangleMesh bumpy_mesh(double radius, double height, int waves,
                                         std::uint32_t rings) {
  return revolved(rings, 2 * rings, [&](double t, double angle) {
    const double tilt = std::numbers::pi * (t - 0.5);
    const double r = radius + height * std::cos(waves * angle) * std::cos(tilt) * std::cos(tilt) *
                                  std::cos(waves * tilt);
    const bool pole = t <= 0 || t >= 1;
    return geometry::Vec3d{pole ? 0 : r * std::cos(tilt) * std::cos(angle),
                           pole ? 0 : r * std::cos(tilt) * std::sin(angle), r * std::sin(tilt)};
  });
}

/// A cylinder round z from 0 to `height`, its side cut into `bands`, its ends flat fans.
inline geometry::TriangleMesh cylinder_mesh(double radius, double height, std::uint32_t bands,
                                            std::uint32_t sectors) {
  const std::uint32_t rings = bands + 2;
  return revolved(rings, sectors, [&](double t, double angle) {
    const double step = std::round(t * rings);
    const bool pole = step < 1 || step >= rings;
    const double z = step < 1 ? 0 : step >= rings ? height : (step - 1) / bands * height;
    return geometry::Vec3d{pole ? 0 : radius * std::cos(angle), pole ? 0 : radius * std::sin(angle),
                           z};
  });
}

}  // namespace strake::test
