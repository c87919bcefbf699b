// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "strake/report/clash.hpp"
#include "strake/report/decisions.hpp"

namespace strake::report {

/// What a review program of others is told of a result.
struct Review {
  /// A result without a decision is new. What was approved or resolved and came back is active,
  /// for these programs have no word for that.
  DecisionStatus status = DecisionStatus::undecided;
  const DecidedResult* decided = nullptr;  ///< null: nothing was decided
};

[[nodiscard]] Review review_of(const ClashContents& contents, std::size_t test,
                               const clash::Pair& pair);

}  // namespace strake::report
