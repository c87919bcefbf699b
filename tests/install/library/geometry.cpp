// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <strake/geometry/predicates.hpp>
#include <strake/geometry/vec.hpp>

int main() {
  const int side = strake::geometry::orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  std::printf("%d\n", side);
  return side != 0 ? 0 : 1;
}
