// SPDX-License-Identifier: Apache-2.0
// Sheets made of profiles drawn out, and how they are placed.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "strake/geometry/mesh.hpp"
#include "strake/geometry/vec.hpp"
#include "support/draw.hpp"

namespace strake::test {

using Profile = std::vector<std::array<double, 2>>;  ///< x and z

/// A profile drawn out along y, in so many bays whose diagonals alternate or not.
inline geometry::TriangleMesh drawn(const Profile& profile, double y0, double y1, int bays = 1,
                                    bool alternate = false) {
  geometry::TriangleMesh mesh;
  const auto count = static_cast<std::uint32_t>(profile.size());
  for (int bay = 0; bay <= bays; ++bay)
    for (const auto& [x, z] : profile) mesh.vertices.push_back({x, y0 + (y1 - y0) * bay / bays, z});
  for (std::uint32_t bay = 0; bay < static_cast<std::uint32_t>(bays); ++bay)
    for (std::uint32_t i = 0; i + 1 < count; ++i) {
      const std::uint32_t a = bay * count + i, b = a + 1, c = b + count, d = a + count;
      const bool other = alternate && (i + bay) % 2 == 1;
      mesh.triangles.push_back(other ? geometry::Triangle{a, b, d} : geometry::Triangle{a, b, c});
      mesh.triangles.push_back(other ? geometry::Triangle{b, c, d} : geometry::Triangle{a, c, d});
    }
  return mesh;
}

/// A profile with more corners along its straight lines.
inline Profile refined(const Profile& profile, int parts) {
  Profile fine{profile.front()};
  for (std::size_t i = 0; i + 1 < profile.size(); ++i)
    for (int k = 1; k <= parts; ++k) {
      const double t = static_cast<double>(k) / parts;
      const auto &p = profile[i], &q = profile[i + 1];
      fine.push_back({p[0] + (q[0] - p[0]) * t, p[1] + (q[1] - p[1]) * t});
    }
  return fine;
}

inline Profile arc(double radius, int first, int last) {
  Profile profile;
  for (int i = first; i <= last; ++i) {
    const double angle = std::numbers::pi * i / 12;
    profile.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return profile;
}

inline geometry::TriangleMesh placed(geometry::TriangleMesh mesh, const geometry::Mat3d& turn,
                                     const geometry::Vec3d& move) {
  for (geometry::Vec3d& v : mesh.vertices) v = turn * v + move;
  return mesh;
}

/// The same triangles in another order, each from any of its corners.
inline geometry::TriangleMesh shuffled(geometry::TriangleMesh mesh, Draw& draw) {
  for (std::size_t i = mesh.triangles.size(); i > 1; --i)
    std::swap(mesh.triangles[i - 1], mesh.triangles[draw.below(i)]);
  for (geometry::Triangle& t : mesh.triangles)
    for (std::uint64_t n = draw.below(3); n > 0; --n) t = {t[1], t[2], t[0]};
  return mesh;
}

}  // namespace strake::test
