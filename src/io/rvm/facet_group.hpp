// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "io/rvm/big_endian.hpp"
#include "strake/geometry/mesh.hpp"

namespace strake::io::rvm {

/// Returns where the facet group that starts at the cursor ends; nothing when a count in it states
/// more than the bytes that are left can hold. Leaves the cursor after the group.
[[nodiscard]] std::optional<Bytes> take_facet_bytes(BigEndianCursor& cursor, Bytes all);

/// A facet group (kind 11) as triangles.
struct FacetMesh {
  geometry::TriangleMesh mesh;
  std::uint32_t polygons = 0;        ///< polygons that the file states
  std::uint32_t nonfinite = 0;       ///< polygons left out: a vertex is not a finite number
  std::uint32_t degenerate = 0;      ///< polygons left out: no contour of three distinct vertices
  std::uint32_t untriangulated = 0;  ///< polygons left out: contours that cross each other
  std::uint32_t short_contours = 0;  ///< holes left out: fewer than three distinct vertices
  float largest = 0;                 ///< the largest absolute coordinate, local units
};

/// Triangulates the polygons of a facet group: holes by the odd rule, orientation by winding (the
/// stored normals are not reliable and are not read), vertices welded where all bits agree,
/// one face id per polygon. A quadrilateral that is not planar is split along the flatter
/// diagonal, and by more than half a degree becomes two faces.
///
/// `payload` is what take_facet_bytes() returned. The mesh's sag stays unknown: the format does not
/// say whether planar facets are the design or an export's approximation of a curved surface.
[[nodiscard]] FacetMesh triangulate_facets(Bytes payload);

}  // namespace strake::io::rvm
