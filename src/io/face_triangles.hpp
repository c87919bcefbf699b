// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "strake/geometry/mesh.hpp"

namespace strake::io {

/// Appends a polygon, given by indices into mesh.vertices, as triangles of the same sense. False
/// when its contour crosses itself or encloses nothing: it is then cut as a fan, which keeps its
/// edges, so that a solid stays closed.
bool append_face(geometry::TriangleMesh& mesh, std::span<const std::uint32_t> corners);

}  // namespace strake::io
