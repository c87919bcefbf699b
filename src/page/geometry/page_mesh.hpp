// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "strake/geometry/mesh.hpp"
#include "strake/geometry/primitive.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/model/scene.hpp"

/// Shapes as a page has them: small numbers on a lattice of their own.
namespace strake::page {

struct PageMesh {
  std::array<float, 3> min{};
  float step = 0;
  std::vector<std::uint16_t> position;  ///< three for each vertex
  std::vector<std::uint16_t> index;     ///< three for each triangle
};

/// Returns triangles in millimetres as page meshes: several where one has more vertices than its
/// indices can name.
[[nodiscard]] std::vector<PageMesh> page_meshes(const geometry::TriangleMesh& mesh);

/// Returns the triangles of a shape on the grid, relative to its origin, and then its lines, in
/// meshes of their own: a line is a triangle whose second and third corners are one vertex.
[[nodiscard]] std::vector<PageMesh> page_meshes(const model::GridShape& shape);

/// How fine a page shows what is curved: corners of a circle. Nobody measures by it, and it is
/// drawn a hundred thousand times.
[[nodiscard]] int circle_corners(double radius_mm);

/// A primitive as a page has it: a shape that others share, and what makes it the primitive.
struct UnitPrimitive {
  geometry::Primitive unit;
  double sag_mm = 0;          ///< of its circles
  geometry::Mat3d from_unit;  ///< of the primitive's own frame
};

/// Returns a primitive as a unit that is scaled, where it can be. `mirrored` says that it is placed
/// turned inside out: then `from_unit` turns it back.
[[nodiscard]] UnitPrimitive unit_of(const geometry::Primitive& primitive, bool mirrored);

}  // namespace strake::page
