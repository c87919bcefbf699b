// SPDX-License-Identifier: Apache-2.0
#include "geometry/depth/boundary_curve.hpp"

#include <cstddef>
#include <cstdint>

namespace strake::geometry {

std::vector<std::array<Vec3d, 2>> boundary_curve(const Part& part) {
  std::vector<std::array<Vec3d, 2>> curve;
  for (std::size_t e = 0; e + 1 < part.edges.size(); ++e) {
    int balance = 0;
    const PartEdge& edge = part.edges[e];
    for (std::uint32_t i = edge.first_triangle; i < part.edges[e + 1].first_triangle; ++i) {
      const Triangle& t = part.triangles[part.edge_triangles[i]];
      for (std::size_t k = 0; k < 3; ++k) {
        if (t[k] == edge.v0 && t[(k + 1) % 3] == edge.v1) ++balance;
        if (t[k] == edge.v1 && t[(k + 1) % 3] == edge.v0) --balance;
      }
    }
    if (balance != 0)
      curve.push_back({part.vertices[edge.v0].as<double>(), part.vertices[edge.v1].as<double>()});
  }
  return curve;
}

}  // namespace strake::geometry
