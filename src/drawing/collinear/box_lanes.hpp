// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace strake::drawing {

/// A box of a plane, in any axes.
struct Box2 {
  float u0, u1, v0, v1;

  /// Returns the empty box, which any other box widens.
  [[nodiscard]] static Box2 nothing() {
    constexpr float kBig = 1e30F;  // half of it from its negative is no infinity
    return {kBig, -kBig, kBig, -kBig};
  }
  void widen(const Box2& by) {
    *this = {std::min(u0, by.u0), std::max(u1, by.u1), std::min(v0, by.v0), std::max(v1, by.v1)};
  }
  [[nodiscard]] Box2 widened(float by) const { return {u0 - by, u1 + by, v0 - by, v1 + by}; }
};

/// A box about axes that are turned by an angle, with its cosine and sine.
struct TurnedBox2 {
  float cosine, sine;
  float u, v, hu, hv;  ///< centre and half sizes in its own axes
};

/// Eight boxes in SIMD lanes, padded with empty ones, tested four at a time: vector extensions of
/// GCC and Clang, which both compile to whatever the processor has. GCC does not vectorise a loop
/// over floats: one box after the other, a search of 2.2 CPU s took 3.7 (decision 0025).
class BoxLanes {
 public:
  static constexpr std::size_t kCount = 8;

  [[nodiscard]] Box2 operator[](std::size_t k) const {
    return {u0_[k / 4][k % 4], u1_[k / 4][k % 4], v0_[k / 4][k % 4], v1_[k / 4][k % 4]};
  }
  void set(std::size_t k, const Box2& box) {
    u0_[k / 4][k % 4] = box.u0;
    u1_[k / 4][k % 4] = box.u1;
    v0_[k / 4][k % 4] = box.v0;
    v1_[k / 4][k % 4] = box.v1;
  }
  [[nodiscard]] Box2 all() const {
    Box2 box = Box2::nothing();
    for (std::size_t k = 0; k < kCount; ++k) box.widen((*this)[k]);
    return box;
  }

  /// Returns the bits of the boxes that have a point in common with a box.
  [[nodiscard]] unsigned meeting(const Box2& box) const {
    Ints found{};
    for (std::size_t h = 0; h < 2; ++h)
      found |= ((u0_[h] <= box.u1) & (u1_[h] >= box.u0) & (v0_[h] <= box.v1) & (v1_[h] >= box.v0)) &
               bits(h);
    return any(found);
  }
  /// Returns the bits of the boxes that the axes of a turned box do not separate from it.
  [[nodiscard]] unsigned meeting(const TurnedBox2& box) const {
    const float c = box.cosine, s = box.sine;
    const float ac = c < 0 ? -c : c, as = s < 0 ? -s : s;
    Ints found{};
    for (std::size_t h = 0; h < 2; ++h) {
      const Floats u = (u0_[h] + u1_[h]) * 0.5F, hu = (u1_[h] - u0_[h]) * 0.5F;
      const Floats v = (v0_[h] + v1_[h]) * 0.5F, hv = (v1_[h] - v0_[h]) * 0.5F;
      const Floats du = u * c + v * s - box.u, dv = v * c - u * s - box.v;
      const Floats ru = hu * ac + hv * as + box.hu, rv = hv * ac + hu * as + box.hv;
      found |= ((du <= ru) & (-du <= ru) & (dv <= rv) & (-dv <= rv)) & bits(h);
    }
    return any(found);
  }

 private:
  using Floats [[gnu::vector_size(16)]] = float;
  using Ints [[gnu::vector_size(16)]] = std::int32_t;

  static Ints bits(std::size_t half) {
    return half == 0 ? Ints{1, 2, 4, 8} : Ints{16, 32, 64, 128};
  }
  static unsigned any(const Ints& found) {
    return static_cast<unsigned>(found[0] | found[1] | found[2] | found[3]);
  }

  std::array<Floats, 2> u0_, u1_, v0_, v1_;
};

}  // namespace strake::drawing
