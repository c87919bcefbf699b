// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cli/evaluate/record.hpp"
#include "strake/core/result.hpp"

// Decision 0064 says why counters guard and seconds are only told.
namespace strake::cli {

/// What became of the cases of an earlier evaluation, a line each.
struct Comparison {
  std::vector<std::string> more_work;  ///< counters that grew by more than 1 %
  std::vector<std::string> less_work;
  /// Times, as ratios to the reference kernel of their own run, that grew by more than 15 % and
  /// what the two machines can tell.
  std::vector<std::string> slower;
  /// Cases, stages and counters of the earlier one that this one does not have.
  std::vector<std::string> missing;
  std::vector<std::string> other_results;  ///< results that are not those of the earlier one
  std::size_t compared = 0;                ///< counters
};

/// Whether the two have the same input. Errors: usage, where they have not the same scale.
[[nodiscard]] Status check_comparable(const EvaluationSettings& before,
                                      const EvaluationSettings& now);

/// Compares the sequential runs. Errors: those of check_comparable().
[[nodiscard]] Result<Comparison> compare_evaluations(const EvaluationRecord& before,
                                                     const EvaluationRecord& now);

}  // namespace strake::cli
