// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "project/database/database.hpp"
#include "project/history/compare_runs.hpp"
#include "project/results/run_records.hpp"
#include "strake/core/result.hpp"

namespace strake::project {

/// A run of which is kept what a comparison needs.
struct KeptRun {
  std::int64_t number = 0;
  RunRecord record;
  std::vector<RunResult> tests;  ///< those that are compared
};

/// Finds the two runs, with what of their tests is to be compared. Errors: those of compare_runs().
[[nodiscard]] Result<std::pair<KeptRun, KeptRun>> runs_to_compare(Database& database,
                                                                  const ComparedRuns& request);

}  // namespace strake::project
