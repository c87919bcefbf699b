// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmpxx.h>

#include <cmath>

namespace strake::test {

/// Rounded to the nearest, ties to even, as IEEE arithmetic does.
inline double nearest_double(const mpq_class& q) {
  // mpq_get_d truncates: look at the neighbour as well.
  const double down = q.get_d();
  const double up = std::nextafter(down, q < 0 ? -INFINITY : INFINITY);
  const mpq_class to_down = abs(q - mpq_class(down)), to_up = abs(mpq_class(up) - q);
  if (to_down != to_up) return to_down < to_up ? down : up;
  int exponent = 0;
  return std::fmod(std::ldexp(std::frexp(down, &exponent), 53), 2) == 0 ? down : up;
}

}  // namespace strake::test
