// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <compare>
#include <cstdint>

#include "strake/geometry/vec.hpp"
#include "strake/geometry/wide_int.hpp"

namespace strake::geometry {

using TriangleCorners = std::array<Vec3l, 3>;

/// Certified bounds on the squared distance of two triangles.
struct DistanceBounds {
  double lower = 0, upper = 0;
};

/// Bounds in double arithmetic. The lower one comes from a slab between the triangles, so it holds
/// however wrongly the nearest features were guessed. Once the lower bound is above `enough` the
/// upper one is not worked out and is infinite.
[[nodiscard]] DistanceBounds distance_bounds(const TriangleCorners& a, const TriangleCorners& b,
                                             double enough);

/// A squared distance: an exact rational, numerator below 2^200 and denominator below 2^136.
struct SquaredDistance {
  Int256 numerator;
  Int192 denominator = Int192(Int128{1});

  friend std::strong_ordering operator<=>(const SquaredDistance& x, const SquaredDistance& y) {
    return mul(x.numerator, y.denominator) <=> mul(y.numerator, x.denominator);
  }
  friend bool operator==(const SquaredDistance& x, const SquaredDistance& y) {
    return (x <=> y) == 0;
  }
};

/// The nearest points of two triangles; among equal distances the pair of features that comes
/// first: corner-corner, corner-edge, edge-corner, corner-face, face-corner, edge-edge.
struct NearestPoints {
  SquaredDistance squared;
  Vec3d on_a, on_b;
};

/// Exact for coordinates whose differences are at most 2^31; zero when the triangles meet.
/// `upper` bounds the squared distance from above, as distance_bounds() gives it.
[[nodiscard]] NearestPoints exact_distance(const TriangleCorners& a, const TriangleCorners& b,
                                           double upper);

}  // namespace strake::geometry
