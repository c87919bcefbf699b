// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/tessellate.hpp"

#include <cmath>
#include <utility>

namespace strake::geometry {
namespace {

Tessellation fault(std::string_view why) {
  Tessellation t;
  t.fault = why;
  return t;
}

/// Eight corners, x fastest, then y, then z; outward quads.
Tessellation hexahedron(const std::array<Vec3d, 8>& corners) {
  static constexpr std::array<std::array<std::uint32_t, 4>, 6> kQuads{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  Tessellation t;
  t.mesh.sag_mm = 0;
  t.mesh.vertices.assign(corners.begin(), corners.end());
  for (std::uint32_t f = 0; f < kQuads.size(); ++f) {
    const auto& q = kQuads[f];
    t.mesh.triangles.push_back({q[0], q[1], q[2]});
    t.mesh.triangles.push_back({q[0], q[2], q[3]});
    t.mesh.faces.insert(t.mesh.faces.end(), {f, f});
  }
  return t;
}

Tessellation make(const BoxPrimitive& b) {
  if (!std::isfinite(b.length_x) || !std::isfinite(b.length_y) || !std::isfinite(b.length_z))
    return fault("a length is not finite");
  std::array<Vec3d, 8> corners;
  for (std::size_t i = 0; i < 8; ++i)
    corners[i] = {(i & 1U) != 0 ? b.length_x / 2 : -b.length_x / 2,
                  (i & 2U) != 0 ? b.length_y / 2 : -b.length_y / 2,
                  (i & 4U) != 0 ? b.length_z / 2 : -b.length_z / 2};
  return hexahedron(corners);
}

template <class P>
Tessellation make(const P&) {
  return fault("kind not supported");
}

}  // namespace

Tessellation tessellate(const Primitive& primitive, const Mat3d& linear, double) {
  Tessellation t = std::visit([](const auto& p) { return make(p); }, primitive);
  for (Vec3d& v : t.mesh.vertices) v = linear * v;
  if (linear.determinant() < 0)
    for (Triangle& tri : t.mesh.triangles) std::swap(tri[1], tri[2]);
  return t;
}

}  // namespace strake::geometry
