// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "strake/clash/clash.hpp"

namespace strake::clash {

/// Pairs of each class, those apart that a rule allows.
struct ByClass {
  std::uint64_t hit = 0, contact = 0, clearance_violation = 0, allowed = 0;

  void add(const Pair& pair) {
    if (pair.allowed >= 0)
      ++allowed;
    else if (pair.cls == Class::hit)
      ++hit;
    else if (pair.cls == Class::contact)
      ++contact;
    else if (pair.cls == Class::clearance_violation)
      ++clearance_violation;
  }
  void add(const ByClass& o) {
    hit += o.hit;
    contact += o.contact;
    clearance_violation += o.clearance_violation;
    allowed += o.allowed;
  }
};

/// What is counted over the pairs of a report.
struct ClassTotals {
  ByClass all;
  std::vector<std::uint64_t> by_rule;  ///< pairs that it allows
  std::vector<ByClass> by_cell;

  ClassTotals(std::size_t rules, std::size_t cells) : by_rule(rules, 0), by_cell(cells) {}
  ClassTotals() = default;

  void add(const Pair& pair, std::size_t cell) {
    all.add(pair);
    if (pair.allowed >= 0) ++by_rule[static_cast<std::size_t>(pair.allowed)];
    if (cell < by_cell.size()) by_cell[cell].add(pair);
  }
  void add(const ClassTotals& o) {
    all.add(o.all);
    for (std::size_t r = 0; r < by_rule.size(); ++r) by_rule[r] += o.by_rule[r];
    for (std::size_t c = 0; c < by_cell.size(); ++c) by_cell[c].add(o.by_cell[c]);
  }
};

}  // namespace strake::clash
