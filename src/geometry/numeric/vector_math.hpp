// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <ranges>

#include "strake/geometry/vec.hpp"

// Lengths, unit vectors, projection intervals and boxes of vectors in doubles.

namespace strake::geometry {

[[nodiscard]] inline double squared_length(const Vec3d& v) { return dot(v, v); }
[[nodiscard]] inline double length(const Vec3d& v) { return std::sqrt(dot(v, v)); }

/// Returns the unit vector along a vector that is not zero.
[[nodiscard]] inline Vec3d unit(const Vec3d& v) { return v * (1 / length(v)); }

/// Returns a unit vector perpendicular to a unit vector and to the coordinate axis least along it.
[[nodiscard]] inline Vec3d perpendicular_to(const Vec3d& n) {
  const double x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
  const Vec3d other = x <= y && x <= z ? Vec3d{1, 0, 0} : y <= z ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1};
  const Vec3d v = cross(n, other);
  return v * (1 / length(v));
}

/// An interval of heights along a direction; empty at first.
struct ProjectionInterval {
  double lo = std::numeric_limits<double>::infinity();
  double hi = -std::numeric_limits<double>::infinity();

  void include(double at) { include(ProjectionInterval{at, at}); }
  void include(const ProjectionInterval& other) {
    lo = std::min(lo, other.lo);
    hi = std::max(hi, other.hi);
  }
};

/// Returns the interval of the corners of a box that is not empty.
[[nodiscard]] inline ProjectionInterval range_along(const Box3d& box, const Vec3d& axis) {
  ProjectionInterval r{0, 0};
  for (int k = 0; k < 3; ++k) {
    const double x = axis[k] * box.lo[k], y = axis[k] * box.hi[k];
    r.lo += std::min(x, y);
    r.hi += std::max(x, y);
  }
  return r;
}

/// Returns the box of points; empty where there are none.
template <std::ranges::contiguous_range Points>
[[nodiscard]] auto box_of(const Points& points) {
  auto box = empty_box<decltype(std::ranges::range_value_t<Points>::x)>();
  for (const auto& p : points) box.include(p);
  return box;
}

/// Returns twice the centre of a box along an axis: exact.
[[nodiscard]] inline std::int64_t twice_centre(const Box3i& box, int axis) {
  return std::int64_t{box.lo[axis]} + box.hi[axis];
}

/// Returns half the surface area of a box, the weight of a node in the surface area heuristic.
[[nodiscard]] inline double half_area(const Box3i& box) {
  const Vec3d d = box.hi.as<double>() - box.lo.as<double>();
  return d.x * d.y + d.y * d.z + d.z * d.x;
}

/// Returns the squared distance of two boxes that are not empty; zero where they meet. Exact but
/// for the rounding of differences and squares.
[[nodiscard]] inline double squared_gap(const Box3d& x, const Box3d& y) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const double gap = std::max(std::max(x.lo[k] - y.hi[k], y.lo[k] - x.hi[k]), 0.0);
    sum += gap * gap;
  }
  return sum;
}
[[nodiscard]] inline double squared_gap(const Vec3d& p, const Box3d& box) {
  return squared_gap(Box3d{p, p}, box);
}

}  // namespace strake::geometry
