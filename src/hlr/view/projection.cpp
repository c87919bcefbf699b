// SPDX-License-Identifier: Apache-2.0
#include "hlr/view/projection.hpp"

#include <cmath>
#include <numeric>

#include "geometry/numeric/vector_math.hpp"

namespace strake::hlr {

using geometry::Vec3d;
using geometry::Vec3l;

ViewAxes axes_of(const View& view) {
  Vec3l right = cross(view.up, view.direction);
  if (right == Vec3l{}) right = cross(Vec3l{0, 1, 0}, view.direction);
  if (right == Vec3l{}) right = {1, 0, 0};
  ViewAxes axes;
  axes.right = geometry::unit(right.as<double>());
  axes.toward = geometry::unit(view.direction.as<double>());
  axes.up = cross(axes.toward, axes.right);
  return axes;
}

Vec3l in_lowest_terms(const Vec3l& d) {
  const std::int64_t g = std::gcd(std::gcd(d.x, d.y), d.z);
  return {d.x / g, d.y / g, d.z / g};
}

}  // namespace strake::hlr
