// SPDX-License-Identifier: Apache-2.0
#include "geometry/tessellate/build.hpp"

#include <utility>

namespace strake::geometry::tessellation {

Tessellation fault(std::string_view why) {
  Tessellation t;
  t.fault = why;
  return t;
}

Vec3d column(const Mat3d& m, int axis) { return {m.row[0][axis], m.row[1][axis], m.row[2][axis]}; }

SinCos canonical_phase(const Vec3d& image_x, const Vec3d& image_y) {
  const Vec3d normal = cross(image_x, image_y);
  const double square = dot(normal, normal);
  if (!(square > 0)) return {0, 1};
  // No usual direction of a pipe lies 26 degrees off the vertical, so rounding errors never decide.
  const bool steep = normal.z * normal.z > 0.81 * square;
  const Vec3d reference = steep ? Vec3d{1, 0, 0} : Vec3d{0, 0, 1};
  const Vec3d u = reference - normal * (dot(reference, normal) / square);
  const double xx = dot(image_x, image_x), yy = dot(image_y, image_y), xy = dot(image_x, image_y);
  const double ux = dot(u, image_x), uy = dot(u, image_y);
  const double x = ux * yy - uy * xy, y = uy * xx - ux * xy;
  const double length = std::sqrt(x * x + y * y);
  if (!(length > 0)) return {0, 1};
  return {y / length, x / length};
}

std::vector<SinCos> rim(int segments, const SinCos& phase) {
  std::vector<SinCos> points = unit_circle(segments);
  for (SinCos& p : points)
    p = {p.sin * phase.cos + p.cos * phase.sin, p.cos * phase.cos - p.sin * phase.sin};
  return points;
}

std::uint32_t Builder::vertex(const Vec3d& v) {
  mesh_.vertices.push_back(v);
  return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
}

void Builder::triangle(std::uint32_t face, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  if (a == b || b == c || c == a) return;
  mesh_.triangles.push_back({a, b, c});
  mesh_.faces.push_back(face);
}

void Builder::polygon(std::span<const std::uint32_t> ring, bool reversed) {
  const std::uint32_t f = face();
  // A zigzag between the two ends: no vertex gathers all the triangles.
  std::size_t low = 0, high = ring.size() - 1;
  bool take_low = true;
  while (high - low >= 2) {
    const std::uint32_t a = ring[low], c = ring[high];
    const std::uint32_t b = take_low ? ring[++low] : ring[--high];
    if (reversed)
      triangle(f, a, c, b);
    else
      triangle(f, a, b, c);
    take_low = !take_low;
  }
}

void Builder::quad_of(std::uint32_t face, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                      std::uint32_t d) {
  triangle(face, a, b, c);
  triangle(face, a, c, d);
}

void Builder::quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  quad_of(face(), a, b, c, d);
}

Tessellation Builder::take(double sag, bool convex) && {
  Tessellation t;
  t.mesh = std::move(mesh_);
  t.mesh.sag_mm = sag;
  t.convex = convex;
  return t;
}

bool are_lengths(std::initializer_list<double> lengths) {
  for (const double length : lengths)
    if (!(length >= 0) || !std::isfinite(length)) return false;
  return true;
}

}  // namespace strake::geometry::tessellation
