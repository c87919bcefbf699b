// SPDX-License-Identifier: Apache-2.0
#include "hlr/edges/edge_on.hpp"

#include <array>
#include <cstddef>

#include "geometry/predicates/exact_normal.hpp"
#include "hlr/view/taxicab.hpp"

namespace strake::hlr {

namespace {

using geometry::ExactNormal;
using geometry::Int128;
using geometry::Vec3l;

}  // namespace

bool may_be_edge_on(const geometry::Part& part, std::uint32_t triangle, const Vec3l& direction) {
  std::array<Vec3l, 3> corner;
  for (std::size_t k = 0; k < 3; ++k)
    corner.at(k) = part.vertices[part.triangles[triangle].at(k)].as<std::int64_t>();
  Int128 lengths = 0, on_paper = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3l side = corner.at((k + 1) % 3) - corner.at(k);
    lengths += taxicab(side);
    on_paper += taxicab(geometry::wide_cross(direction, side));
  }
  const ExactNormal normal = geometry::triangle_normal(part, triangle);
  const Int128 facing = magnitude(geometry::along(normal, direction));
  // Rounding changes the normal by less than the sum of the sides.
  return 2 * facing <= on_paper + 3 * taxicab(direction) && taxicab(normal) > 2 * lengths;
}

}  // namespace strake::hlr
