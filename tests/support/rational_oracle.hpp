// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmpxx.h>

#include <array>
#include <vector>

#include "support/lattice_solids.hpp"

/// Brute force in big rationals, on purpose by other means than the library: volumes of clipped
/// tetrahedra instead of local contacts, normal equations instead of closed feature formulas.
namespace strake::testing {

using RationalPoint = std::array<mpq_class, 3>;

/// Six times the volume of the part common to two bodies.
[[nodiscard]] mpq_class common_volume6(const std::vector<Tetrahedron>& a,
                                       const std::vector<Tetrahedron>& b);
[[nodiscard]] mpq_class volume6(const std::vector<Tetrahedron>& pieces);

/// How much of a sheet (projected area, added up over its triangles) lies where in a body.
struct SheetCover {
  mpq_class inside, on_surface, all;
};
[[nodiscard]] SheetCover sheet_cover(const IndexedMesh& sheet, const LatticeSolid& body);

/// Projected area of the sheet a that another sheet without overlaps covers, and all of it.
[[nodiscard]] SheetCover sheet_cover(const IndexedMesh& sheet, const IndexedMesh& other);

/// Least squared distance between two surfaces.
[[nodiscard]] mpq_class squared_distance(const IndexedMesh& a, const IndexedMesh& b);

}  // namespace strake::testing
