// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "strake/geometry/mesh.hpp"

namespace strake::io {

/// Appends a polygon, given by indices into mesh.vertices, as triangles of the same sense.
void append_face(geometry::TriangleMesh& mesh, std::span<const std::uint32_t> corners);

}  // namespace strake::io
