// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "strake/geometry/part.hpp"

namespace strake::geometry {

/// A set of shell numbers; parts with more than 64 shells are rare.
class ShellSet {
 public:
  void insert(std::uint32_t shell) {
    if (shell < 64) {
      low_ |= std::uint64_t{1} << shell;
      return;
    }
    if (high_.size() <= shell - 64) high_.resize(shell - 63, false);
    high_[shell - 64] = true;
  }
  void insert(const ShellSet& other) {
    low_ |= other.low_;
    high_.resize(std::max(high_.size(), other.high_.size()), false);
    for (std::size_t i = 0; i < other.high_.size(); ++i)
      if (other.high_[i]) high_[i] = true;
  }
  [[nodiscard]] bool contains(std::uint32_t shell) const {
    if (shell < 64) return ((low_ >> shell) & 1) != 0;
    return shell - 64 < high_.size() && high_[shell - 64];
  }

 private:
  std::uint64_t low_ = 0;
  std::vector<bool> high_;
};

[[nodiscard]] inline std::uint32_t shell_of(const Part& part, std::uint32_t triangle) {
  return part.shells.empty() ? 0 : part.shells[triangle];
}

}  // namespace strake::geometry
