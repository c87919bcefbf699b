// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace strake::clash {

/// Rules of the form "one of A and one of B" as bits of each object, so that all rules are asked
/// about a pair at once.
class SetMasks {
 public:
  explicit SetMasks(std::size_t objects, std::size_t rules)
      : words_((rules + kBits - 1) / kBits), bits_(objects * words_) {}

  void set(std::size_t rule, const std::vector<bool>& a, const std::vector<bool>& b) {
    const std::size_t word = rule / kBits;
    const std::uint64_t bit = std::uint64_t{1} << (rule % kBits);
    for (std::size_t o = 0; o < a.size(); ++o) {
      Bits& bits = bits_[o * words_ + word];
      if (a[o]) bits.a |= bit;
      if (b[o]) bits.b |= bit;
    }
  }

  /// Calls `take(rule)` for each rule that concerns the two, in order, until it returns true.
  template <class Take>
  void each(std::uint32_t x, std::uint32_t y, Take&& take) const {
    for (std::size_t w = 0; w < words_; ++w) {
      const Bits &p = bits_[x * words_ + w], &q = bits_[y * words_ + w];
      for (std::uint64_t both = (p.a & q.b) | (p.b & q.a); both != 0; both &= both - 1)
        if (take(w * kBits + static_cast<std::size_t>(std::countr_zero(both)))) return;
    }
  }

 private:
  static constexpr std::size_t kBits = 64;
  struct Bits {
    std::uint64_t a = 0, b = 0;
  };
  std::size_t words_;
  std::vector<Bits> bits_;  ///< words_ of each object
};

}  // namespace strake::clash
