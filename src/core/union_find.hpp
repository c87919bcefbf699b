// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace strake {

/// Sets of the numbers 0 … n-1 that can only be joined. The lowest member of a set is its root, so
/// that roots do not depend on the order of the joins.
class UnionFind {
 public:
  explicit UnionFind(std::size_t n = 0) { reset(n); }

  /// Resets it to n single sets; the memory is kept.
  void reset(std::size_t n) {
    parent_.resize(n);
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
    count_ = n;
  }

  [[nodiscard]] std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  /// Joins two sets; returns whether they were apart before. There is no branch, which would often
  /// be as good as chance.
  bool join(std::uint32_t i, std::uint32_t j) {
    i = root(i);
    j = root(j);
    parent_[std::max(i, j)] = std::min(i, j);
    const bool apart = i != j;
    count_ -= apart ? 1U : 0U;
    return apart;
  }

  [[nodiscard]] bool joined(std::uint32_t i, std::uint32_t j) { return root(i) == root(j); }
  [[nodiscard]] std::size_t count() const { return count_; }  ///< the number of sets

 private:
  std::vector<std::uint32_t> parent_;  ///< a parent is never higher than the member
  std::size_t count_ = 0;
};

}  // namespace strake
