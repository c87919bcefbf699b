// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <TopoDS_Shape.hxx>

namespace strake::import_step {

/// Whether a shape has plane faces with straight edges and nothing else, so that its triangles are
/// its surface.
[[nodiscard]] bool has_flat_faces_only(const TopoDS_Shape& shape);

/// Returns how far at most the triangles that Open CASCADE has made of the faces of a shape lie
/// from its surfaces, mm: what was requested of the mesher, or what is found at the middles of
/// triangles and of their sides, if that is more. The mesher gives up on a face after so many
/// attempts, and says nothing then.
[[nodiscard]] double largest_sag_found(const TopoDS_Shape& shape, double wanted_sag_mm);

}  // namespace strake::import_step
