// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/srgb.hpp"

#include <algorithm>
#include <array>

namespace strake::io::gltf {
namespace {

/// Returns the fifth root by Newton's method from above: no libm, so the same bits everywhere.
constexpr double fifth_root(double x) {
  double root = 1;
  for (int i = 0; i < 60; ++i) {
    const double square = root * root;
    root = (4 * root + x / (square * square)) / 5;
  }
  return root;
}

constexpr double decode(int value) {
  const double share = value / 255.0;
  if (share <= 0.04045) return share / 12.92;
  const double base = (share + 0.055) / 1.055;
  return base * base * fifth_root(base * base);  // base^2.4
}

constexpr std::array<double, 256> make_table() {
  std::array<double, 256> table{};
  for (int i = 0; i < 256; ++i) table[static_cast<std::size_t>(i)] = decode(i);
  return table;
}

constexpr std::array<double, 256> kLinear = make_table();

}  // namespace

double linear_of_srgb(std::uint8_t value) { return kLinear[value]; }

std::uint8_t srgb_of_linear(double linear) {
  if (!(linear > 0)) return 0;
  const auto above = std::lower_bound(kLinear.begin(), kLinear.end(), linear);
  if (above == kLinear.end()) return 255;
  auto index = above - kLinear.begin();
  if (index > 0 && linear - *(above - 1) < *above - linear) --index;
  return static_cast<std::uint8_t>(index);
}

}  // namespace strake::io::gltf
