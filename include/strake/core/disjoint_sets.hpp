// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace strake {

/// The numbers 0 … n-1 in sets that can only be joined. The lowest member of a set is its root, so
/// that roots do not depend on the order of the joins.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }

  [[nodiscard]] std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  /// Whether they were apart before.
  bool join(std::uint32_t i, std::uint32_t j) {
    i = root(i);
    j = root(j);
    parent_[std::max(i, j)] = std::min(i, j);
    return i != j;
  }

  [[nodiscard]] bool joined(std::uint32_t i, std::uint32_t j) { return root(i) == root(j); }

 private:
  std::vector<std::uint32_t> parent_;  ///< never higher than the member
};

}  // namespace strake
