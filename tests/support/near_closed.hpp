// SPDX-License-Identifier: Apache-2.0
// Meshes as exporters write closed bodies: triangles with corners of their own, each a little off.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "strake/geometry/mesh.hpp"
#include "support/draw.hpp"
#include "support/meshes.hpp"
#include "support/revolved_meshes.hpp"
#include "support/tube_mesh.hpp"

namespace strake::test {

/// A closed body about the origin, in millimetres, and a ball in it.
struct ClosedBody {
  geometry::TriangleMesh mesh;
  geometry::Vec3d centre;  ///< of the largest ball
  double radius = 0;
};

inline ClosedBody closed_box(double x, double y, double z) {
  return {box_mesh({-x / 2, -y / 2, -z / 2}, {x / 2, y / 2, z / 2}), {}, std::min({x, y, z}) / 2};
}

inline ClosedBody closed_cylinder(double radius, double height, std::uint32_t sectors) {
  return {cylinder_mesh(radius, height, 1, sectors),
          {0, 0, height / 2},
          std::min(radius * std::cos(std::numbers::pi / sectors), height / 2)};
}

inline ClosedBody closed_tube(double outer, double inner, double length, std::uint32_t sides) {
  const auto corner = [](double x, double y, double z) { return geometry::Vec3d{x, y, z}; };
  const double middle = (outer + inner) / 2;
  return {tube<geometry::TriangleMesh>(sides, outer, inner, -length / 2, length / 2, corner),
          {middle, 0, 0},
          (outer - inner) / 2 * 0.5};
}

inline ClosedBody drawn_body(Draw& draw) {
  switch (draw.below(3)) {
    case 0:
      return closed_box(draw.between(20, 3000), draw.between(20, 3000), draw.between(20, 3000));
    case 1:
      return closed_cylinder(draw.between(20, 800), draw.between(40, 3000),
                             3 + static_cast<std::uint32_t>(draw.below(60)));
    default:
      return closed_tube(draw.between(400, 600), draw.between(100, 300), draw.between(100, 3000),
                         6 + static_cast<std::uint32_t>(draw.below(42)));
  }
}

/// Each triangle with corners of its own.
inline geometry::TriangleMesh soup_of(const geometry::TriangleMesh& mesh) {
  geometry::TriangleMesh soup;
  soup.faces = mesh.faces;
  for (const geometry::Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t v : t) soup.vertices.push_back(mesh.vertices[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

/// Every corner moved by no more than `most`, mm.
inline void jitter(geometry::TriangleMesh& mesh, double most, Draw& draw) {
  for (geometry::Vec3d& v : mesh.vertices) {
    geometry::Vec3d off;
    do {
      off = {draw.between(-1, 1), draw.between(-1, 1), draw.between(-1, 1)};
    } while (dot(off, off) > 1);
    v = v + off * most;
  }
}

/// Splits sides of triangles at drawn points of them and leaves the triangle beyond as it is:
/// T-junctions. No piece is shorter than `least`.
inline void split_sides_mm(geometry::TriangleMesh& mesh, int tries, double least, Draw& draw) {
  for (int i = 0; i < tries; ++i) {
    const auto number = static_cast<std::size_t>(draw.below(mesh.triangles.size()));
    const auto side = static_cast<std::size_t>(draw.below(3));
    const geometry::Triangle t = mesh.triangles[number];
    const std::uint32_t a = t[side], c = t[(side + 1) % 3], top = t[(side + 2) % 3];
    const geometry::Vec3d way = mesh.vertices[c] - mesh.vertices[a];
    const double part = draw.between(0.1, 0.9);
    if (std::sqrt(dot(way, way)) * 0.1 < least) continue;
    const auto b = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(mesh.vertices[a] + way * part);
    mesh.triangles[number] = {a, b, top};
    mesh.triangles.push_back({b, c, top});
  }
}

inline void place_mesh(geometry::TriangleMesh& mesh, const geometry::Mat3d& turn,
                       const geometry::Vec3d& by) {
  for (geometry::Vec3d& v : mesh.vertices) v = turn * v + by;
}

/// As numbers of single precision; returns half their spacing at the largest of them, mm.
inline double through_float32(geometry::TriangleMesh& mesh) {
  double largest = 0;
  for (geometry::Vec3d& v : mesh.vertices)
    for (int k = 0; k < 3; ++k) {
      v[k] = static_cast<double>(static_cast<float>(v[k]));
      largest = std::max(largest, std::fabs(v[k]));
    }
  const auto top = static_cast<float>(largest);
  return static_cast<double>(std::nextafter(top, 2 * top) - top) / 2;
}

/// Triangles in another order, each begun at another corner, vertices in another order.
inline void shuffle(geometry::TriangleMesh& mesh, Draw& draw) {
  std::vector<std::uint32_t> order(mesh.vertices.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[draw.below(i)]);
  std::vector<geometry::Vec3d> vertices(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) vertices[order[i]] = mesh.vertices[i];
  mesh.vertices = std::move(vertices);
  for (geometry::Triangle& t : mesh.triangles) {
    for (std::uint32_t& v : t) v = order[v];
    std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(draw.below(3)), t.end());
  }
  for (std::size_t i = mesh.triangles.size(); i > 1; --i)
    std::swap(mesh.triangles[i - 1], mesh.triangles[draw.below(i)]);
}

}  // namespace strake::test
