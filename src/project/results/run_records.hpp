// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "project/database/database.hpp"
#include "strake/core/result.hpp"
#include "strake/report/clash.hpp"

/// What is remembered of each run besides its counts. Runs of the first version of the tables have
/// no such records.
namespace strake::project {

/// How a run grouped its results, as written; `by` is empty where it did not.
struct RunGrouping {
  std::string by, distance, classes, sort;
  bool contacts = false;
};

struct RunRecord {
  std::optional<report::RulesSource> rules;  ///< the rules file, if there was one
  RunGrouping grouping;
  std::int64_t last_event = 0;  ///< the last that there was when it ended
};

/// What a run found in a test.
struct RunResult {
  std::int64_t test = 0;
  std::string name;
  std::string settings;  ///< for people
  std::string hash;      ///< clash::Report::hash
};

/// Writes the record of a run that ends, of which all else is written; `last_event` is found.
[[nodiscard]] Status write_run_record(Database& database, std::int64_t run,
                                      const RunRecord& record);
[[nodiscard]] Status write_run_result(Database& database, std::int64_t run,
                                      const RunResult& result);

/// Returns nothing where there is no such run, or no record of it.
[[nodiscard]] Result<std::optional<RunRecord>> read_run_record(Database& database,
                                                               std::int64_t run);
/// Returns what a run found, by test in the order of their first runs.
[[nodiscard]] Result<std::vector<RunResult>> read_run_results(Database& database, std::int64_t run);
/// Returns the number of the last run; nothing where there was none.
[[nodiscard]] Result<std::optional<std::int64_t>> last_run(Database& database);

}  // namespace strake::project
