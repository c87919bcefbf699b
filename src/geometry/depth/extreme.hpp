// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/geometry/part.hpp"
#include "strake/geometry/part_tree.hpp"

namespace strake::geometry {

/// The greatest n·v over the vertices of a part's triangles, as doubles give it. A tree changes
/// the work only, from all vertices to those near the answer; without one the tree is not used.
[[nodiscard]] double greatest_along(const Part& part, const PartTree* tree, const Vec3d& n);

}  // namespace strake::geometry
