// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace strake::drawing {

/// Which of two lines stays where they lie on each other: the lower rank, then the nearer.
enum class Rank : std::uint8_t { visible, hidden, none };  ///< none: covers nothing, is not covered

/// Both ends of a line, the same whichever way it runs.
using Ends = std::array<double, 4>;

/// A line in a plane, in whatever unit the caller measures.
struct Flat {
  double ax = 0, ay = 0, bx = 0, by = 0;
  double depth = 0;  ///< larger is nearer to the viewer
  double reach = 0;  ///< two lines lie on each other up to the sum of their reaches
  Rank rank = Rank::none;

  [[nodiscard]] double length() const {
    const double x = bx - ax, y = by - ay;
    return std::sqrt(x * x + y * y);
  }
  [[nodiscard]] Ends ends() const {
    if (bx < ax || (bx == ax && by < ay)) return {bx, by, ax, ay};
    return {ax, ay, bx, by};
  }
};

}  // namespace strake::drawing
