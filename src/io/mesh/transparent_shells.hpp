// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "strake/geometry/mesh.hpp"
#include "strake/model/model.hpp"

namespace strake::io {

/// Merges shells that close only with opaque and transparent faces, as a tank with a sight glass. A
/// mesh of a file is cut into its opaque and its transparent faces, which are drawn differently;
/// such a shell would be two open sheets then, and nothing would be found inside it. So its
/// transparent faces are moved to the opaque mesh. Corners of exactly equal coordinates are one;
/// shells are connected by edges. Returns whether there is such a shell. O(n log n) where both
/// kinds occur, else nothing.
bool merge_transparent_shells(geometry::TriangleMesh& opaque, geometry::TriangleMesh& transparent);

/// Adds a note that the object, or mesh, that `where` names has such a shell.
void note_merged_shell(model::Model& model, std::string where);

}  // namespace strake::io
