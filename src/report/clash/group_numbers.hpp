// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "strake/report/clash.hpp"

namespace strake::report {

/// Gives the number of the group that each result is in, if it is in one.
class GroupNumbers {
 public:
  explicit GroupNumbers(const ClashContents& contents) {
    if (contents.grouping == nullptr) return;
    for (const clash::Report& test : contents.findings.tests)
      numbers_.emplace_back(test.pairs.size(), kNone);
    const std::vector<clash::Group>& groups = contents.grouping->groups;
    for (std::uint32_t g = 0; g < groups.size(); ++g)
      for (const clash::ResultRef& r : groups[g].results) numbers_[r.test][r.pair] = g;
  }

  [[nodiscard]] std::optional<std::uint32_t> of(std::size_t test, std::size_t pair) const {
    if (numbers_.empty() || numbers_[test][pair] == kNone) return std::nullopt;
    return numbers_[test][pair];
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;
  std::vector<std::vector<std::uint32_t>> numbers_;
};

}  // namespace strake::report
