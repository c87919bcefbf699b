// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <TopoDS_Shape.hxx>
#include <cstddef>

#include "strake/geometry/mesh.hpp"

namespace strake::import_step {

/// The triangles of a shape, with one vertex where its faces meet.
struct StitchedMesh {
  geometry::TriangleMesh mesh;    ///< in mm; outside counter-clockwise where the shape says so
  std::size_t faces = 0;          ///< of the shape
  std::size_t faces_without = 0;  ///< those that have no triangles
  bool is_closed = false;         ///< each edge is passed once in each direction
  double moved_mm = 0;            ///< how far at most a point went to be that of another face
};

/// Takes the triangles that Open CASCADE has made of the faces of a shape. Faces that share an edge
/// share the points on it, whatever the tolerances of the file leave between them.
[[nodiscard]] StitchedMesh stitched_mesh(const TopoDS_Shape& shape);

}  // namespace strake::import_step
