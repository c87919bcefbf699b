// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace strake::geometry {

/// A union-find with parity over the numbers 0 … n-1: each member has two sides, and a join says
/// whether the first side of one is the first or the second of the other. The lowest member of a
/// set is its root.
class ParityUnionFind {
 public:
  explicit ParityUnionFind(std::size_t n = 0) : up_(n), swapped_(n, false) {
    std::iota(up_.begin(), up_.end(), 0U);
  }

  struct Root {
    std::uint32_t root = 0;
    bool swapped = false;  ///< the member's first side is the root's second
  };

  [[nodiscard]] Root find(std::uint32_t i) {
    Root r{i, false};
    while (up_[r.root] != r.root) {
      const std::uint32_t next = up_[r.root];
      // Path halving; the root itself is never swapped.
      swapped_[r.root] = swapped_[r.root] != swapped_[next];
      up_[r.root] = up_[next];
      r.swapped = r.swapped != swapped_[r.root];
      r.root = up_[r.root];
    }
    return r;
  }

  /// Joins two members; false where they were in one set already, with the other parity.
  bool join(std::uint32_t i, std::uint32_t j, bool swapped) {
    const Root x = find(i), y = find(j);
    const bool turned = (x.swapped != y.swapped) != swapped;
    if (x.root == y.root) return !turned;
    up_[std::max(x.root, y.root)] = std::min(x.root, y.root);
    swapped_[std::max(x.root, y.root)] = turned;
    return true;
  }

 private:
  std::vector<std::uint32_t> up_;  ///< never higher than the member
  std::vector<bool> swapped_;      ///< against up_
};

}  // namespace strake::geometry
