// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "project/database/database.hpp"
#include "project/results/run_records.hpp"
#include "project/results/stored_tests.hpp"
#include "project/snapshot/snapshot.hpp"
#include "strake/clash/clash.hpp"
#include "strake/clash/incremental.hpp"
#include "strake/clash/policy.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"
#include "strake/report/clash.hpp"
#include "strake/report/decisions.hpp"

/// Runs of clash tests taken into a project: results, clashes, and what becomes of them.
namespace strake::project {

enum class Retested : std::uint8_t { full, changes, nothing };
/// Returns "full", "changes" or "nothing".
[[nodiscard]] std::string_view name(Retested how);

/// What a run did for a test.
struct TestWork {
  Retested how = Retested::full;
  std::uint64_t objects = 0, changed_objects = 0;
  std::uint64_t tested_pairs = 0;  ///< that the narrow phase looked at
  std::uint64_t kept_results = 0;  ///< results of the earlier run that hold
};

/// A test of a run, to be remembered. All pointers must be there but `before` and
/// `changes`.
struct TestedTest {
  const clash::Report* report = nullptr;  ///< Report::name is the test's
  const Snapshot* snapshot = nullptr;     ///< what it was computed from
  const clash::Sets* sets = nullptr;
  const clash::Policy* policy = nullptr;
  const StoredTest* before = nullptr;  ///< as read before the run; null: there was none
  TestWork work;
  /// What the run did to the results of `before`, whose report then is clash::FollowedRun::earlier;
  /// null: all of them are to be compared.
  const clash::PairChanges* changes = nullptr;
};

/// What a run found, beside what its report counts.
struct TestTrend {
  std::uint64_t appeared = 0;  ///< found for the first time, or again
  std::uint64_t gone = 0;      ///< resolved by this run
  std::uint64_t cannot_tell = 0;
  std::uint64_t resolved = 0;  ///< all of the test
  std::uint64_t written = 0;   ///< rows of clashes that were written
};

/// What decisions have of what people said.
enum class RunComments : std::uint8_t {
  none,          ///< what holds now
  all_comments,  ///< all comments of people
  with_history,  ///< and what was set along with it: who sees to a clash, comments taken back
};

struct RunFacts {
  std::string started;  ///< UTC, as 2026-01-31T23:59:59Z
  std::string who;
  double seconds = 0;
  double deeper_mm = 1;  ///< an approved clash that is deeper by more comes back
  std::optional<report::RulesSource> rules = {};  ///< the rules file, if there was one
  RunGrouping grouping = {};
  RunComments comments = RunComments::none;  ///< what decisions are to have
};

/// A run that is remembered.
struct RememberedRun {
  std::int64_t number = 0;
  std::vector<TestTrend> trends;               ///< of each test
  std::unique_ptr<report::DecisionFile> file;  ///< the decisions that `decided` refers to
  /// What was decided about the results, for reports: those that nobody has decided about are
  /// Active, but for those found by this run for the first time.
  report::DecidedResults decided;
};

/// Writes a run: its results, its clashes and the changes of their status. Only rows that change
/// are written. To be called within a transaction, so that all of it is written or nothing. Errors:
/// input for a damaged project, output where the database cannot be written, cancelled.
[[nodiscard]] Result<RememberedRun> remember(Database& database, const model::Model& model,
                                             const RunFacts& facts,
                                             std::span<const TestedTest> tests,
                                             const parallel::Context& context);

}  // namespace strake::project
