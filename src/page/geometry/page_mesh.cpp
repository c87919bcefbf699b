// SPDX-License-Identifier: Apache-2.0
#include "page/geometry/page_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <unordered_map>
#include <variant>

#include "geometry/numeric/trig.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::page {
namespace {

using geometry::Vec3d;

constexpr double kMaxSteps = 65535;
constexpr std::size_t kMaxVertices = 65535;

/// Triangles with vertices of their own, put on a lattice.
PageMesh quantised(const std::vector<Vec3d>& vertices, std::vector<std::uint16_t> index) {
  PageMesh mesh;
  mesh.index = std::move(index);
  geometry::Box3d box = geometry::empty_box<double>();
  for (const Vec3d& v : vertices) box.include(v);
  const Vec3d size = box.hi - box.lo;
  mesh.min = {static_cast<float>(box.lo.x), static_cast<float>(box.lo.y),
              static_cast<float>(box.lo.z)};
  const double step = std::max({size.x, size.y, size.z, 1e-6}) / kMaxSteps;
  // Rounded up, so that the farthest corner has a number.
  mesh.step = std::nextafter(static_cast<float>(step), HUGE_VALF);
  mesh.position.reserve(vertices.size() * 3);
  for (const Vec3d& v : vertices)
    for (int k = 0; k < 3; ++k)
      mesh.position.push_back(static_cast<std::uint16_t>(std::clamp(
          std::round((v[k] - double{mesh.min[static_cast<std::size_t>(k)]}) / double{mesh.step}),
          0.0, kMaxSteps)));
  return mesh;
}

/// Gathers triangles until indices would no longer do.
class MeshCutter {
 public:
  /// `vertex(i)` is in millimetres.
  template <class Vertex>
  void add(const geometry::Triangle& triangle, const Vertex& vertex) {
    if (vertices_.size() + 3 > kMaxVertices) flush();
    for (const std::uint32_t v : triangle) {
      const auto [at, is_new] = numbers_.try_emplace(v, vertices_.size());
      if (is_new) vertices_.push_back(vertex(v));
      index_.push_back(static_cast<std::uint16_t>(at->second));
    }
  }
  /// `vertex(i)` is in millimetres. A line is a triangle whose second and third vertices are one.
  template <class Vertex>
  void add_line(std::uint32_t from, std::uint32_t to, const Vertex& vertex) {
    add({from, to, to}, vertex);
  }
  /// Vertices are counted anew.
  void next_part() { numbers_.clear(); }
  /// What follows is a mesh of its own.
  void next_mesh() { flush(); }
  std::vector<PageMesh> finish() {
    flush();
    return std::move(meshes_);
  }

 private:
  void flush() {
    if (!index_.empty()) meshes_.push_back(quantised(vertices_, std::move(index_)));
    numbers_.clear();
    vertices_.clear();
    index_.clear();
  }
  std::unordered_map<std::uint32_t, std::size_t> numbers_;
  std::vector<Vec3d> vertices_;
  std::vector<std::uint16_t> index_;
  std::vector<PageMesh> meshes_;
};

geometry::Mat3d scaled(double x, double y, double z) {
  return {{Vec3d{x, 0, 0}, Vec3d{0, y, 0}, Vec3d{0, 0, z}}};
}

/// The largest distance of a circle from so many chords.
double sag_of(double radius, double of_radius) {
  const int corners = circle_corners(of_radius);
  // A little more, so that no rounding requests another corner.
  return geometry::sagitta(radius, 2 * geometry::kPi / corners) * 1.001;
}

/// Finds the unit of each kind: what is placed mirrored is a mirrored unit that is mirrored once
/// more. In a mirror boxes, cylinders, spheres and dishes stay what they are along x, tori along z.
class UnitFinder {
 public:
  explicit UnitFinder(bool mirrored) : x_(mirrored ? -1 : 1) {}

  UnitPrimitive operator()(const geometry::BoxPrimitive& p) const {
    return {geometry::BoxPrimitive{1, 1, 1}, 1, scaled(x_ * p.length_x, p.length_y, p.length_z)};
  }
  UnitPrimitive operator()(const geometry::CylinderPrimitive& p) const {
    return {geometry::CylinderPrimitive{1, 1}, sag_of(1, p.radius),
            scaled(x_ * p.radius, p.radius, p.height)};
  }
  UnitPrimitive operator()(const geometry::SpherePrimitive& p) const {
    return {geometry::SpherePrimitive{2}, sag_of(1, p.diameter / 2),
            scaled(x_ * p.diameter / 2, p.diameter / 2, p.diameter / 2)};
  }
  UnitPrimitive operator()(const geometry::EllipticalDishPrimitive& p) const {
    return {geometry::EllipticalDishPrimitive{1, 1}, sag_of(1, p.radius),
            scaled(x_ * p.radius, p.radius, p.height)};
  }
  UnitPrimitive operator()(const geometry::SphericalDishPrimitive& p) const {
    return own(p, p.radius);
  }
  UnitPrimitive operator()(geometry::PyramidPrimitive p) const {
    p.offset_x *= x_;
    return own(p, 0);
  }
  UnitPrimitive operator()(geometry::SnoutPrimitive p) const {
    p.offset_x *= x_;
    p.bottom_shear_x *= x_;
    p.top_shear_x *= x_;
    return own(p, std::max(p.bottom_radius, p.top_radius));
  }
  /// Elbows of a plant are of few forms and many sizes.
  UnitPrimitive operator()(const geometry::CircularTorusPrimitive& p) const {
    const Vec3d size = {p.centre_radius, p.centre_radius, x_ * p.centre_radius};
    constexpr double kForms = 4096;  // of a torus, by how thick it is
    const double tube = std::round(p.tube_radius / p.centre_radius * kForms) / kForms;
    if (!(tube > 0 && tube < kForms))
      return {p, p.tube_radius > 0 ? sag_of(p.tube_radius, p.tube_radius) : 1, scaled(1, 1, x_)};
    return {geometry::CircularTorusPrimitive{1, tube, p.angle}, sag_of(tube, p.tube_radius),
            scaled(size.x, size.y, size.z)};
  }
  UnitPrimitive operator()(const geometry::RectangularTorusPrimitive& p) const {
    return {p, p.outer_radius > 0 ? sag_of(p.outer_radius, p.outer_radius) : 1, scaled(1, 1, x_)};
  }
  UnitPrimitive operator()(const geometry::LinePrimitive& p) const { return own(p, 0); }

 private:
  template <class Primitive>
  [[nodiscard]] UnitPrimitive own(const Primitive& p, double radius) const {
    return {p, radius > 0 ? sag_of(radius, radius) : 1, scaled(x_, 1, 1)};
  }
  double x_;
};

}  // namespace

int circle_corners(double radius_mm) {
  constexpr std::array<std::pair<double, int>, 4> kBySize{
      {{20, 8}, {150, 12}, {600, 16}, {2000, 24}}};
  for (const auto& [radius, corners] : kBySize)
    if (radius_mm <= radius) return corners;
  return 48;
}

std::vector<PageMesh> page_meshes(const geometry::TriangleMesh& mesh) {
  MeshCutter cutter;
  for (const geometry::Triangle& t : mesh.triangles)
    cutter.add(t, [&](std::uint32_t v) { return mesh.vertices[v]; });
  return cutter.finish();
}

std::vector<PageMesh> page_meshes(const model::GridShape& shape) {
  MeshCutter cutter;
  const auto vertex_of = [](const geometry::Part& part) {
    return [&part](std::uint32_t v) { return geometry::to_mm(part.vertices[v].as<double>()); };
  };
  for (const geometry::Part& part : shape.parts) {
    cutter.next_part();
    for (const geometry::Triangle& t : part.triangles) cutter.add(t, vertex_of(part));
  }
  cutter.next_mesh();
  for (const geometry::Part& part : shape.parts) {
    cutter.next_part();
    for (std::size_t c = 0; c + 1 < part.chain_first.size(); ++c)
      for (std::uint32_t v = part.chain_first[c]; v + 1 < part.chain_first[c + 1]; ++v)
        cutter.add_line(v, v + 1, vertex_of(part));
  }
  return cutter.finish();
}

UnitPrimitive unit_of(const geometry::Primitive& primitive, bool mirrored) {
  return std::visit(UnitFinder(mirrored), primitive);
}

}  // namespace strake::page
