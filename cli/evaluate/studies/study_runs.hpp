// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "cli/evaluate/contender.hpp"
#include "cli/evaluate/studies/studies.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/report.hpp"

/// What studies are made of.
namespace strake::cli {

/// How a contender of a study runs.
struct StudyConditions {
  parallel::Distribution distribution = parallel::Distribution::planned;
  std::size_t min_chunk = 1;  ///< as of parallel::Context
  bool with_regions = false;  ///< regions are reported, which reads clocks for each block
};

/// Timed runs of one contender.
struct StudyRun {
  double seconds = 0;  ///< the median
  Computed computed;
  std::vector<parallel::RegionReport> regions;  ///< of the fastest round, where requested
  std::string unfinished;                       ///< why it has no result; empty: it has

  /// Returns the seconds as text, or why there are none.
  [[nodiscard]] std::string text() const;
  /// Returns a counter as text; "-" where there is none.
  [[nodiscard]] std::string counter(const std::string& name) const;
};

/// Runs a contender `settings.repeat` times, or until the limit of the evaluation ends it.
[[nodiscard]] Result<StudyRun> run_for_study(const StudyInput& input, const Contender& contender,
                                             const StudyConditions& conditions = {});

/// Returns how many times as long one run took as another.
[[nodiscard]] std::string times(const StudyRun& slower, const StudyRun& faster);

/// Returns whether two runs came to the same result, where both did; a difference is the study's.
[[nodiscard]] std::string equal(const StudyRun& x, const StudyRun& y, const std::string& what,
                                StudyRecord& study);

// The studies.
[[nodiscard]] Status study_bucketing(const StudyInput& input, StudyRecord& study);
[[nodiscard]] Status study_distribution(const StudyInput& input, StudyRecord& study);
[[nodiscard]] Status study_existing_view(const StudyInput& input, StudyRecord& study);
[[nodiscard]] Status study_gap(const StudyInput& input, StudyRecord& study);
[[nodiscard]] Status study_granularity(const StudyInput& input, StudyRecord& study);
[[nodiscard]] Status study_imported(const StudyInput& input, StudyRecord& study);
[[nodiscard]] Status study_longest_first(const StudyInput& input, StudyRecord& study);
[[nodiscard]] Status study_memory(const StudyInput& input, StudyRecord& study);
[[nodiscard]] Status study_push_and_gather(const StudyInput& input, StudyRecord& study);
[[nodiscard]] Status study_stage_one(const StudyInput& input, StudyRecord& study);
[[nodiscard]] Status study_octree(const StudyInput& input, StudyRecord& study);

}  // namespace strake::cli
