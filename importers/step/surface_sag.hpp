// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <TopoDS_Shape.hxx>

namespace strake::import_step {

/// Whether a shape has plane faces with straight edges and nothing else, so that its triangles are
/// its surface.
[[nodiscard]] bool has_flat_faces_only(const TopoDS_Shape& shape);

/// Returns how far the surfaces of a shape lie from the triangles that Open CASCADE has made of its
/// faces, mm, as found at the middles of the triangles and of their sides: the mesher gives up on a
/// face after so many attempts, and says nothing then.
[[nodiscard]] double largest_sag_found(const TopoDS_Shape& shape);

}  // namespace strake::import_step
