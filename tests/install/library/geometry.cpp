// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <strake/geometry/plane_intersection.hpp>
#include <strake/geometry/predicates.hpp>
#include <strake/geometry/vec.hpp>

int main() {
  using namespace strake::geometry;
  const int side = orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  const TriangleCorners floor{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  const TriangleCorners wall{{{4, 0, 0}, {4, 1, 0}, {4, 0, 1}}};
  const bool meet = intersect_planes(floor, wall).common == CommonOfPlanes::line;
  std::printf("%d %d\n", side, meet ? 1 : 0);
  return side != 0 && meet ? 0 : 1;
}
