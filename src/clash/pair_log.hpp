// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "clash/narrow.hpp"
#include "clash/parts.hpp"

namespace strake::clash {

/// Gathers Report::log from pairs of parts in the order of near_pairs().
class PairLog {
 public:
  explicit PairLog(const PartList& list) : list_(list) {}

  /// `repeated`: an earlier pair was the same question, so that this one took no work of its own.
  void add(const geometry::IndexPair& pair, const NarrowWork& work, bool repeated);
  /// The classes are those of the report's pairs; what it does not hold is NO_HIT.
  void close(Report& report);
  [[nodiscard]] std::vector<LoggedPair>& pairs() { return pairs_; }

 private:
  const PartList& list_;
  std::vector<LoggedPair> pairs_;
};

}  // namespace strake::clash
