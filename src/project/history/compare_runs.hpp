// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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

/// How many results a run counted in a test, those included that have no rows: contacts that are
/// only counted, and what a rule allows.
struct ResultCounts {
  std::uint64_t hit = 0, contact = 0, clearance_violation = 0;  ///< that no rule allows
  std::uint64_t allowed = 0;                                    ///< of any class
};

/// The same of a test that both runs ran.
struct TestCounts {
  std::string test;
  ResultCounts before, after;
};

/// Two runs and what changed, which refers to them.
struct RunComparison {
  report::ClashDocument before, after;  ///< results, rules and settings, no objects without results
  report::ClashDiff diff;
  std::vector<TestCounts> counts;  ///< in the order of the later run
};

/// Compares by what each run said of each clash, so that it tells what the runs told: new is what
/// appeared, gone what was resolved, with the rule where one allows it, and of what a run could not
/// tell the reason is that of the run. A clash that neither run found is in no list. Results that a
/// rule has always allowed, and contacts that were only ever counted, are no clashes: of them there
/// is nothing but RunComparison::counts.
///
/// Errors: usage for a test or a run that there is not, for runs that are not in order, and for
/// runs of which nothing is kept: those of the first version of the tables; input for a damaged
/// project.
[[nodiscard]] Result<std::unique_ptr<RunComparison>> compare_runs(Database& database,
                                                                  const ComparedRuns& request);

}  // namespace strake::project
