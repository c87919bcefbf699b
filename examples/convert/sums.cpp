// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "mass.hpp"

namespace convert {
namespace {

using Coordinates = std::array<std::int64_t, 3>;

Coordinates coordinates(const Point& p) { return {p.x, p.y, p.z}; }

Coordinates cross(const Coordinates& a, const Coordinates& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

void Sums::add(const Point& pa, const Point& pb, const Point& pc) {
  const Coordinates a = coordinates(pa), b = coordinates(pb), c = coordinates(pc);
  const Coordinates ab = cross(a, b), bc = cross(b, c), ca = cross(c, a);
  const Int128 volume = Int128{a[0]} * bc[0] + Int128{a[1]} * bc[1] + Int128{a[2]} * bc[2];
  volume_6 += volume;
  Coordinates sum{};
  for (std::size_t i = 0; i < 3; ++i) {
    sum[i] = a[i] + b[i] + c[i];
    moment_24[i] += volume * sum[i];
    area_vector[i] += ab[i] + bc[i] + ca[i];
  }
  constexpr std::array<std::array<std::size_t, 2>, 6> kAxes{
      {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {2, 0}, {0, 1}}};
  for (std::size_t k = 0; k < kAxes.size(); ++k) {
    const auto [i, j] = kAxes[k];
    second_120[k] += volume * (sum[i] * sum[j] + a[i] * a[j] + b[i] * b[j] + c[i] * c[j]);
  }
}

void Sums::add(const Sums& other) {
  volume_6 += other.volume_6;
  for (std::size_t i = 0; i < 3; ++i) {
    moment_24[i] += other.moment_24[i];
    area_vector[i] += other.area_vector[i];
  }
  for (std::size_t k = 0; k < 6; ++k) second_120[k] += other.second_120[k];
}

std::string text(Int128 value) {
  std::string digits;
  const bool negative = value < 0;
  // Digit by digit with its sign: the least number has no positive counterpart.
  do {
    const auto digit = static_cast<int>(value % 10);
    digits += static_cast<char>('0' + (digit < 0 ? -digit : digit));
    value /= 10;
  } while (value != 0);
  if (negative) digits += '-';
  std::reverse(digits.begin(), digits.end());
  return digits;
}

}  // namespace convert
