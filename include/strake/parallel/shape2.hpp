// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace strake::parallel {

/// Two nested loops as one flat range, so that the team shares rows × columns items however the
/// two are proportioned. The product is 64 bits wide: 50,000 × 50,000 does not fit an int.
struct Shape2 {
  struct Index {
    std::uint32_t row = 0, column = 0;
    friend constexpr bool operator==(const Index&, const Index&) = default;
  };

  std::uint32_t rows = 0, columns = 0;

  [[nodiscard]] constexpr std::uint64_t size() const {
    return std::uint64_t{rows} * std::uint64_t{columns};
  }
  /// Row by row; flat < size().
  [[nodiscard]] constexpr Index index(std::uint64_t flat) const {
    return {static_cast<std::uint32_t>(flat / columns), static_cast<std::uint32_t>(flat % columns)};
  }
  [[nodiscard]] constexpr std::uint64_t flat(Index at) const {
    return std::uint64_t{at.row} * columns + at.column;
  }
};

}  // namespace strake::parallel
