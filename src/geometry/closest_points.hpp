// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/pair_view.hpp"
#include "geometry/triangle_distance.hpp"

namespace strake::geometry {

/// Of two triangles by their numbers.
[[nodiscard]] inline Closest as_closest(const NearestPoints& nearest, const NodePair& triangles) {
  Closest close;
  close.squared = ratio_to_double(nearest.squared.numerator, nearest.squared.denominator);
  close.distance = sqrt_ratio_to_double(nearest.squared.numerator, nearest.squared.denominator);
  close.lower = close.distance;
  close.on_a = nearest.on_a;
  close.on_b = nearest.on_b;
  close.triangle_a = triangles.a;
  close.triangle_b = triangles.b;
  return close;
}

}  // namespace strake::geometry
