// SPDX-License-Identifier: Apache-2.0
#pragma once

// Edges of a tessellation between facets that look towards the viewer and away, beside the true
// contours of the primitive.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <variant>
#include <vector>

#include "geometry/primitives/tessellate.hpp"
#include "strake/geometry/mesh.hpp"
#include "strake/geometry/primitive.hpp"

namespace strake::test {

using geometry::CircularTorusPrimitive;
using geometry::CylinderPrimitive;
using geometry::EllipticalDishPrimitive;
using geometry::Primitive;
using geometry::SnoutPrimitive;
using geometry::SpherePrimitive;
using geometry::SphericalDishPrimitive;
using geometry::Tessellation;
using geometry::Triangle;
using geometry::TriangleMesh;
using geometry::Vec3d;

inline Vec3d unit(const Vec3d& v) { return v * (1 / std::sqrt(dot(v, v))); }

/// The outward normal of the curved skin of a primitive at one of its points.
inline Vec3d normal_at(const Primitive& primitive, const Vec3d& p) {
  if (std::holds_alternative<CylinderPrimitive>(primitive)) return unit({p.x, p.y, 0});
  if (const auto* s = std::get_if<SnoutPrimitive>(&primitive)) {
    const double grow = s->top_radius - s->bottom_radius, k = p.z / s->height + 0.5;
    const Vec3d out = unit({p.x - s->offset_x * (k - 0.5), p.y - s->offset_y * (k - 0.5), 0});
    return unit({out.x * s->height, out.y * s->height,
                 -(s->offset_x * out.x + s->offset_y * out.y + grow)});
  }
  if (std::holds_alternative<SpherePrimitive>(primitive)) return unit(p);
  if (const auto* d = std::get_if<EllipticalDishPrimitive>(&primitive))
    return unit(
        {p.x / d->radius / d->radius, p.y / d->radius / d->radius, p.z / d->height / d->height});
  if (const auto* d = std::get_if<SphericalDishPrimitive>(&primitive)) {
    const double radius = (d->radius * d->radius / d->height + d->height) / 2;
    return unit({p.x, p.y, p.z - d->height + radius});
  }
  const auto& t = std::get<CircularTorusPrimitive>(primitive);
  const Vec3d out = unit({p.x, p.y, 0});
  return unit(p - out * t.centre_radius);
}

/// A mesh's faces, by edge of two vertices.
struct Net {
  const TriangleMesh& mesh;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> faces;
  std::map<std::uint32_t, Vec3d> area, corners;  ///< by face; sums
  std::map<std::uint32_t, int> triangles;

  explicit Net(const TriangleMesh& m) : mesh(m) {
    for (std::size_t t = 0; t < m.triangles.size(); ++t) {
      const Triangle& w = m.triangles[t];
      const auto& v = m.vertices;
      area[m.faces[t]] = area[m.faces[t]] + cross(v[w[1]] - v[w[0]], v[w[2]] - v[w[0]]);
      corners[m.faces[t]] = corners[m.faces[t]] + v[w[0]] + v[w[1]] + v[w[2]];
      ++triangles[m.faces[t]];
      for (std::size_t k = 0; k < 3; ++k)
        faces[std::minmax(w[k], w[(k + 1) % 3])].push_back(m.faces[t]);
    }
  }
  /// Edges between two facets of the curved side of which one looks towards the viewer.
  [[nodiscard]] std::vector<std::pair<Vec3d, Vec3d>> contours(const Vec3d& towards) const {
    return contours_if([&](std::uint32_t face) { return dot(area.at(face), towards) > 0; });
  }
  [[nodiscard]] std::vector<std::pair<Vec3d, Vec3d>> contours_from(const Vec3d& eye) const {
    return contours_if([&](std::uint32_t face) {
      const Vec3d middle = corners.at(face) * (1.0 / (3 * triangles.at(face)));
      return dot(area.at(face), eye - middle) > 0;
    });
  }
  template <class Faces>
  [[nodiscard]] std::vector<std::pair<Vec3d, Vec3d>> contours_if(const Faces& is_towards) const {
    std::vector<std::pair<Vec3d, Vec3d>> result;
    for (const auto& [edge, of] : faces) {
      EXPECT_EQ(of.size(), 2U);
      if (of.size() != 2 || of[0] == of[1]) continue;
      if (triangles.at(of[0]) > 2 || triangles.at(of[1]) > 2) continue;
      if (is_towards(of[0]) != is_towards(of[1]))
        result.emplace_back(mesh.vertices[edge.first], mesh.vertices[edge.second]);
    }
    return result;
  }
};

/// The same for an eye: how far the sight through the ends of the contours is from the tangent
/// plane there, of 1.
inline double worst_end_from(const Vec3d& eye, const Primitive& primitive, const Tessellation& t) {
  double worst = 0;
  for (const auto& [a, b] : Net(t.mesh).contours_from(eye))
    for (const Vec3d& p : {a, b})
      worst = std::max(worst, std::fabs(dot(normal_at(primitive, p), unit(eye - p))));
  return worst;
}

/// How many vertices of a pipe on its end at z >= 0 are met by one of a dish's rim at z = 0, beside
/// it to within so much across the axis, and how many are not.
struct RimMeeting {
  std::size_t met = 0, missed = 0;
};
inline RimMeeting rims_of(const Tessellation& dish, const Tessellation& pipe, double beside) {
  std::vector<Vec3d> rim;
  for (const Vec3d& v : dish.mesh.vertices)
    if (std::fabs(v.z) < 1e-9) rim.push_back(v);
  RimMeeting rims;
  for (const Vec3d& v : pipe.mesh.vertices) {
    if (v.z < 0) continue;
    const bool is_met = std::ranges::any_of(
        rim, [&](const Vec3d& w) { return std::hypot(v.x - w.x, v.y - w.y) < beside; });
    ++(is_met ? rims.met : rims.missed);
  }
  return rims;
}

/// The ends of lines where only one of them ends; more than two lines nowhere.
inline std::vector<Vec3d> loose_ends(const std::vector<std::pair<Vec3d, Vec3d>>& lines) {
  std::map<std::array<double, 3>, int> ends;
  for (const auto& [a, b] : lines) ++ends[{a.x, a.y, a.z}], ++ends[{b.x, b.y, b.z}];
  std::vector<Vec3d> loose;
  for (const auto& [p, n] : ends) {
    EXPECT_LE(n, 2);
    if (n == 1) loose.push_back({p[0], p[1], p[2]});
  }
  return loose;
}

}  // namespace strake::test
