// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "strake/clash/relation.hpp"

namespace strake::clash {

/// Which of its results a test reports, allowed or not. The others are counted
/// (Report::not_reported). What is not certain is reported: a result flagged kUncertain whatever
/// its relation, and a hit whose common volume may be as large as requested, or is not known.
struct Reporting {
  /// A pair is reported where it, or any two parts of it, stand so to each other; empty: however
  /// they do.
  RelationSet relations = {};
  double min_volume_mm3 = 0;  ///< hits with less in common, allowed or not, are not reported

  [[nodiscard]] bool leaves_out() const { return !relations.empty() || min_volume_mm3 > 0; }
};

/// Results that a test found and does not report, by their classes as in the counts of a report.
struct NotReported {
  struct Counts {
    std::uint64_t hit = 0, contact = 0, clearance_violation = 0, allowed = 0;
    [[nodiscard]] std::uint64_t all() const {
      return hit + contact + clearance_violation + allowed;
    }
  };
  Counts by_relation, by_volume;  ///< what both leave out counts for the relation
};

}  // namespace strake::clash
