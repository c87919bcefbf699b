// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "project/database/database.hpp"
#include "project/results/clash_queries.hpp"
#include "project/results/run_records.hpp"
#include "strake/clash/clash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"
#include "strake/report/decisions.hpp"

namespace strake::project {

/// The results of tests of one run, and the names of the model that it ran over, under the labels
/// that its files have today.
struct LastRun {
  std::int64_t number = 0;
  clash::Findings findings;
  std::vector<std::vector<std::int64_t>> rows;  ///< of each test RememberedReport::rows
  model::Model model;                           ///< objects and files, without bodies
  std::optional<RunRecord> record;
};

/// Returns the error (usage) of a project without results.
[[nodiscard]] Error no_result(const Database& database);

/// Reads the last results of tests, which are of one run. Errors: usage where one was never run, or
/// is of the first version of the tables; input for a damaged project; cancelled.
[[nodiscard]] Result<LastRun> read_last_run(Database& database,
                                            const std::vector<std::string>& tests,
                                            const parallel::Context& context);

/// What people have decided by now about the results of a run. It may be moved: what refers to each
/// other stays where it is.
struct DecisionsOfNow {
  std::map<std::int64_t, ListedClash> clashes;  ///< by row
  std::unique_ptr<report::DecisionFile> file;   ///< the decisions that `decided` refers to
  report::DecidedResults decided;
};

/// Looks up what was decided, status and all, as 'strake clash list' tells it. Errors: those of
/// list_clashes().
[[nodiscard]] Result<DecisionsOfNow> decisions_of_now(Database& database, const LastRun& run);

}  // namespace strake::project
