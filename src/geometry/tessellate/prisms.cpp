// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "geometry/tessellate/build.hpp"

namespace strake::geometry::tessellation {
namespace {

constexpr std::string_view kBadLength = "a length is negative or not finite";

/// Eight corners, x fastest, then y, then z; edges and corners may coincide.
Tessellation hexahedron(const std::array<Vec3d, 8>& corners) {
  static constexpr std::array<std::array<std::uint32_t, 4>, 6> kQuads{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  Builder builder;
  for (const Vec3d& c : corners) builder.vertex(c);
  for (const auto& q : kQuads) builder.quad(q[0], q[1], q[2], q[3]);
  return std::move(builder).take(0, true);
}

double pick(std::size_t corner, std::size_t bit, double length) {
  return (corner & bit) != 0 ? length / 2 : -length / 2;
}

}  // namespace

Tessellation make(const BoxPrimitive& p, const Target&) {
  if (!are_lengths({p.length_x, p.length_y, p.length_z})) return fault(kBadLength);
  std::array<Vec3d, 8> corners;
  for (std::size_t i = 0; i < 8; ++i)
    corners[i] = {pick(i, 1, p.length_x), pick(i, 2, p.length_y), pick(i, 4, p.length_z)};
  return hexahedron(corners);
}

Tessellation make(const PyramidPrimitive& p, const Target&) {
  if (!are_lengths({p.bottom_x, p.bottom_y, p.top_x, p.top_y, p.height}) ||
      !std::isfinite(p.offset_x) || !std::isfinite(p.offset_y))
    return fault(kBadLength);
  std::array<Vec3d, 8> corners;
  for (std::size_t i = 0; i < 8; ++i) {
    const bool top = (i & 4U) != 0;
    corners[i] = {pick(i, 4, p.offset_x) + pick(i, 1, top ? p.top_x : p.bottom_x),
                  pick(i, 4, p.offset_y) + pick(i, 2, top ? p.top_y : p.bottom_y),
                  pick(i, 4, p.height)};
  }
  return hexahedron(corners);
}

Tessellation make(const LinePrimitive& p, const Target&) {
  if (!are_lengths({p.length}) || p.length == 0) return fault("a line of no length");
  Tessellation t;
  t.lines.points = {{0, 0, -p.length / 2}, {0, 0, p.length / 2}};
  t.lines.first = {0, 2};
  return t;
}

}  // namespace strake::geometry::tessellation
