// SPDX-License-Identifier: Apache-2.0
#include "io/face_triangles.hpp"

namespace strake::io {

void append_face(geometry::TriangleMesh& mesh, std::span<const std::uint32_t> corners) {
  for (std::size_t i = 2; i < corners.size(); ++i)
    mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

}  // namespace strake::io
