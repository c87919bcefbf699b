// SPDX-License-Identifier: Apache-2.0
// Seeded numbers and rotations, the same on every platform.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include "strake/geometry/vec.hpp"

namespace strake::test {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}

  double between(double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(random_() >> 11U) * 0x1p-53;
  }
  /// Of lo..hi-1.
  std::int32_t whole(std::int32_t lo, std::int32_t hi) {
    return static_cast<std::int32_t>(std::floor(between(lo, hi)));
  }
  bool one_in(std::uint64_t n) { return random_() % n == 0; }
  std::uint64_t below(std::uint64_t n) { return random_() % n; }

  /// A rotation from a random quaternion.
  geometry::Mat3d rotation() {
    std::array<double, 4> q{};
    double size = 0;
    for (double& x : q) {
      x = between(-1, 1);
      size += x * x;
    }
    const double s = 2 / size;
    const auto [w, x, y, z] = q;
    geometry::Mat3d m;
    m.row = {geometry::Vec3d{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
             geometry::Vec3d{s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
             geometry::Vec3d{s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}};
    return m;
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace strake::test
