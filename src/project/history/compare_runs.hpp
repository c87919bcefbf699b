// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "project/database/database.hpp"
#include "strake/core/result.hpp"
#include "strake/report/clash_diff.hpp"

/// What changed between two runs that a project remembers.
namespace strake::project {

/// Which runs are compared.
struct ComparedRuns {
  std::optional<std::string> test;  ///< absent: all tests that the later one ran
  std::optional<std::pair<std::int64_t, std::int64_t>> runs;  ///< absent: the last two of the tests
};

/// Two runs and what changed, which refers to them.
struct RunComparison {
  report::ClashDocument before, after;  ///< results, rules and settings, no objects without results
  report::ClashDiff diff;
};

/// Compares by what each run said of each clash, so that it tells what the runs told: new is what
/// appeared, gone what was resolved, with the rule where one allows it, and of what a run could not
/// tell the reason is that of the run. A clash that neither run found is in no list. Results that a
/// rule has always allowed, and contacts that were only ever counted, are no clashes.
///
/// Errors: usage for a test or a run that there is not, for runs that are not in order, and for
/// runs of which nothing is kept: those of the first version of the tables; input for a damaged
/// project.
[[nodiscard]] Result<std::unique_ptr<RunComparison>> compare_runs(Database& database,
                                                                  const ComparedRuns& asked);

}  // namespace strake::project
