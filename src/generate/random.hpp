// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace strake::generate {

/// Numbers that depend on the seed and the place they are used at, not on what was drawn before:
/// a cell's contents stay the same whatever the rest of the ship does.
/// The mixing function is that of SplitMix64 (Steele, Lea, Flood 2014).
class Random {
 public:
  explicit constexpr Random(std::uint64_t key) : state_(mix(key)) {}

  /// An independent stream for a place within this one.
  [[nodiscard]] constexpr Random at(std::uint64_t place) const {
    return Random(state_ ^ mix(place + 0x632be59bd9b4e019U));
  }
  constexpr std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15U;
    return mix(state_);
  }
  /// Uniform in [0, count); count > 0 and small, so the bias of the remainder is without effect.
  constexpr std::uint32_t below(std::uint32_t count) {
    return static_cast<std::uint32_t>((next() >> 32U) % count);
  }
  /// A whole number of [lo, hi].
  constexpr int between(int lo, int hi) {
    return lo + static_cast<int>(below(static_cast<std::uint32_t>(hi - lo + 1)));
  }
  constexpr bool chance(std::uint32_t percent) { return below(100) < percent; }

 private:
  static constexpr std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }
  std::uint64_t state_;
};

}  // namespace strake::generate
