// SPDX-License-Identifier: Apache-2.0
// Whether a path on one sheet passes through another so that no small moves undo it.
#pragma once

#include <array>
#include <vector>

#include "strake/geometry/mesh.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::test {

using PathSegment = std::array<geometry::Vec3d, 2>;

/// The edges at which a mesh ends, its corners welded within a nanometre. Millimetres.
[[nodiscard]] std::vector<PathSegment> rim_of(const geometry::TriangleMesh& mesh);

/// Whether some stretch of the path, from one of its points to another, meets the sheet an odd
/// number of times, has both ends at least `off` from the sheet, and keeps `margin` from the rims.
/// That number does not change its parity as long as nothing moves by more than these: then the
/// path and the sheet cross whatever is done to them. (The intersection number modulo 2 is an
/// invariant of homotopy; Guillemin and Pollack, Differential Topology, chapter 2.) In doubles, by
/// brute force; where the path runs in the sheet it is nudged out of it, by less than a
/// micrometre.
[[nodiscard]] bool passes_through(const std::vector<geometry::Vec3d>& path,
                                  const geometry::TriangleMesh& sheet,
                                  const std::vector<PathSegment>& rims, double off, double margin);

}  // namespace strake::test
