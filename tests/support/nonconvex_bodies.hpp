// SPDX-License-Identifier: Apache-2.0
// Bodies that are not convex, for tests of depth; grid units.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "part_builder.hpp"
#include "strake/geometry/depth.hpp"
#include "tube_mesh.hpp"

namespace strake::testing {

using geometry::Vec3i;

inline geometry::Depth depth_of(const Subject& a, const Subject& b,
                                const geometry::DepthOptions& goal = {}) {
  const geometry::FaceKdop pa = make_face_kdop(a.part), pb = make_face_kdop(b.part);
  geometry::QueryContext work;
  return solid_depth({a.treed(), &pa}, {b.treed(), &pb}, goal, work);
}

/// Whether they have interior in common.
inline bool interiors_meet(const Subject& a, const Subject& b) {
  geometry::QueryContext work;
  const geometry::Meeting meeting = meet(a.treed(), b.treed(), work).meeting;
  return meeting != geometry::Meeting::apart && meeting != geometry::Meeting::touching;
}

/// With the touch that meet() finds, as the narrow phase asks.
inline geometry::Depth depth_from_touch(const Subject& a, const Subject& b,
                                        geometry::DepthOptions goal) {
  geometry::QueryContext work;
  const geometry::MeetingResult meeting = meet(a.treed(), b.treed(), work);
  goal.triangle_a = meeting.triangle_a;
  goal.triangle_b = meeting.triangle_b;
  goal.meeting_point = meeting.point;
  return depth_of(a, b, goal);
}

/// The depth at a point of the grid by definition, of two that are not turned against it; 0 where
/// it lies outside either.
inline double depth_at(const Subject& a, const Subject& b, const geometry::Vec3l& p) {
  geometry::QueryContext work;
  double deep = 0;
  for (const Subject* s : {&a, &b}) {
    const geometry::Vec3l own = p - s->origin;
    if (side_of(s->treed(), own, 1, work) == geometry::PointSide::outside) return 0;
    deep = std::max(deep, nearest_on_surface(s->treed(), own.as<double>()).distance);
  }
  return deep;
}

/// A regular prism along z with `sides` corners on radius r, snapped to the grid.
inline IndexedMesh cylinder(int sides, double r, std::int32_t z0, std::int32_t z1) {
  std::vector<Vec3i> ring;
  for (int i = 0; i < sides; ++i) {
    const double t = 2 * std::numbers::pi * i / sides;
    ring.push_back({static_cast<std::int32_t>(std::lround(r * std::cos(t))),
                    static_cast<std::int32_t>(std::lround(r * std::sin(t))), 0});
  }
  return prism_mesh(ring, z0, z1);
}

/// A tube round z; grid units.
inline IndexedMesh tube(int sides, double outer, double inner, std::int32_t z0, std::int32_t z1) {
  return test::tube<IndexedMesh>(
      static_cast<std::uint32_t>(sides), outer, inner, z0, z1, [](double x, double y, double z) {
        return Vec3i{static_cast<std::int32_t>(std::lround(x)),
                     static_cast<std::int32_t>(std::lround(y)), static_cast<std::int32_t>(z)};
      });
}

/// A prism along x over an outline in the yz plane, its ends cut into quads of the outline's
/// corners.
inline IndexedMesh extruded(std::int32_t length,
                            std::span<const std::array<std::int32_t, 2>> outline,
                            std::span<const std::array<std::uint32_t, 4>> ends) {
  const auto n = static_cast<std::uint32_t>(outline.size());
  IndexedMesh mesh;
  for (const std::int32_t x : {0, length})
    for (const auto& p : outline) mesh.vertices.push_back({x, p[0], p[1]});
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    quad(i, i + n, j + n, j);
  }
  for (const auto& q : ends) {
    quad(q[0], q[1], q[2], q[3]);
    quad(q[3] + n, q[2] + n, q[1] + n, q[0] + n);
  }
  return mesh.flipped();
}

/// A channel: an open-topped U along x made of a single non-convex solid.
inline IndexedMesh channel(std::int32_t length, std::int32_t width, std::int32_t height,
                           std::int32_t wall) {
  const std::array<std::array<std::int32_t, 2>, 8> outline{{{0, 0},
                                                            {width, 0},
                                                            {width, height},
                                                            {width - wall, height},
                                                            {width - wall, wall},
                                                            {wall, wall},
                                                            {wall, height},
                                                            {0, height}}};
  constexpr std::array<std::array<std::uint32_t, 4>, 3> kEnds{
      {{0, 1, 4, 5}, {1, 2, 3, 4}, {0, 5, 6, 7}}};
  return extruded(length, outline, kEnds);
}

/// An I beam along x, its web in the xz plane.
inline IndexedMesh beam(std::int32_t length, std::int32_t width, std::int32_t height,
                        std::int32_t flange, std::int32_t web) {
  const std::int32_t y = width / 2, w = web / 2, top = height - flange;
  const std::array<std::array<std::int32_t, 2>, 12> outline{{{-y, 0},
                                                             {y, 0},
                                                             {y, flange},
                                                             {w, flange},
                                                             {w, top},
                                                             {y, top},
                                                             {y, height},
                                                             {-y, height},
                                                             {-y, top},
                                                             {-w, top},
                                                             {-w, flange},
                                                             {-y, flange}}};
  constexpr std::array<std::array<std::uint32_t, 4>, 7> kEnds{{{0, 10, 11, 0},
                                                               {0, 1, 3, 10},
                                                               {1, 2, 3, 1},
                                                               {10, 3, 4, 9},
                                                               {9, 7, 8, 9},
                                                               {9, 4, 6, 7},
                                                               {4, 5, 6, 4}}};
  return extruded(length, outline, kEnds);
}

/// A quarter turn round z.
inline IndexedMesh crosswise(IndexedMesh mesh) {
  for (Vec3i& v : mesh.vertices) v = {-v.y, v.x, v.z};
  return mesh;
}

/// Snapped to the grid again.
inline IndexedMesh turned_by(const geometry::Mat3d& turn, IndexedMesh mesh) {
  for (Vec3i& v : mesh.vertices) {
    const geometry::Vec3d p = v.as<double>();
    for (int k = 0; k < 3; ++k)
      v[k] = static_cast<std::int32_t>(std::lround(dot(turn.row[static_cast<std::size_t>(k)], p)));
  }
  return mesh;
}

/// Turned by a rational rotation (quaternion 1, 2, 3, 4 over 30) and snapped.
inline IndexedMesh turned(IndexedMesh mesh) {
  const std::array<std::array<double, 3>, 3> m{{{-20, 4, 22}, {20, -10, 20}, {10, 28, 4}}};
  for (Vec3i& v : mesh.vertices) {
    std::array<double, 3> p{};
    for (std::size_t k = 0; k < 3; ++k) p[k] = (m[k][0] * v.x + m[k][1] * v.y + m[k][2] * v.z) / 30;
    v = {static_cast<std::int32_t>(std::lround(p[0])), static_cast<std::int32_t>(std::lround(p[1])),
         static_cast<std::int32_t>(std::lround(p[2]))};
  }
  return mesh;
}

}  // namespace strake::testing
