// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/evaluate/contender.hpp"
#include "cli/evaluate/studies/studies.hpp"

/// What studies are made of.
namespace strake::cli {

/// Timed runs of one contender.
struct StudyRun {
  double seconds = 0;  ///< the median
  Computed computed;
  std::string unfinished;  ///< why it has no result; empty: it has

  /// Returns the seconds as text, or why there are none.
  [[nodiscard]] std::string text() const;
  /// Returns a counter as text; "-" where there is none.
  [[nodiscard]] std::string counter(const std::string& name) const;
};

/// Runs a contender `settings.repeat` times, or until the limit of the evaluation ends it.
[[nodiscard]] Result<StudyRun> run_for_study(const StudyInput& input, const Contender& contender);

// The studies.
[[nodiscard]] Status study_bucketing(const StudyInput& input, StudyRecord& study);
[[nodiscard]] Status study_push_and_gather(const StudyInput& input, StudyRecord& study);
[[nodiscard]] Status study_gap(const StudyInput& input, StudyRecord& study);
[[nodiscard]] Status study_imported(const StudyInput& input, StudyRecord& study);

}  // namespace strake::cli
