// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "strake/geometry/mesh.hpp"
#include "strake/model/model.hpp"

namespace strake::io {

/// A mesh of a file is cut into its opaque and its transparent faces, which are drawn differently.
/// A shell that closes only with faces of both, as a tank with a sight glass, would be two open
/// sheets then, and nothing would be found inside it: the transparent faces of such shells are
/// moved to the opaque mesh. Corners of exactly equal coordinates are one; shells hang together by
/// edges. True where there is such a shell. O(n log n) where both kinds occur, else nothing.
bool merge_transparent_shells(geometry::TriangleMesh& opaque, geometry::TriangleMesh& transparent);

/// Tells of the object, or mesh, that `where` names that it has such a shell.
void note_merged_shell(model::Model& model, std::string where);

}  // namespace strake::io
