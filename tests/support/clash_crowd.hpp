// SPDX-License-Identifier: Apache-2.0
// Boxes of which many touch, and whether two runs say the same of them.
#pragma once

#include <cstddef>
#include <random>
#include <string>

#include "support/clash_model.hpp"

namespace strake::test {

/// Boxes of random places and sizes on a coarse lattice, so that many touch.
inline ClashModel crowd(unsigned seed, std::size_t n) {
  std::mt19937 random(seed);
  const auto pick = [&](int from, int to) {
    return 5.0 * static_cast<double>(
                     from + static_cast<int>(random() % static_cast<unsigned>(to - from + 1)));
  };
  ClashModel m;
  for (std::size_t i = 0; i < n; ++i) {
    const geometry::Vec3d at{pick(0, 60), pick(0, 60), pick(0, 60)};
    m.box("o" + std::to_string(100 + i), at,
          at + geometry::Vec3d{pick(2, 20), pick(2, 20), pick(2, 20)});
  }
  return m;
}

/// Whether two results of pairs are the same.
inline bool same(const clash::Pair& x, const clash::Pair& y) {
  return x.a == y.a && x.b == y.b && x.cls == y.cls && x.relation == y.relation &&
         x.flags == y.flags && x.d_mm == y.d_mm && x.d_lower_mm == y.d_lower_mm &&
         x.d_upper_mm == y.d_upper_mm && x.point_mm == y.point_mm && x.part_a == y.part_a &&
         x.part_b == y.part_b && x.allowed == y.allowed;
}

}  // namespace strake::test
