// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "project/results/clash_rows.hpp"
#include "strake/core/result.hpp"

/// What people ask of remembered clashes, and what they decide about them.
namespace strake::project {

struct ListedClash {
  ClashRow row;
  std::string test;
  report::DecisionStatus status{};  ///< as people see it
  std::int64_t last_run = 0;        ///< the last run of the test
};

/// Which clashes are wanted; what is absent says nothing.
struct ClashFilter {
  std::optional<report::DecisionStatus> status;
  std::optional<std::string> test;
};

/// Returns clashes by test and in the order in which they were found. Errors: usage for a test that
/// was never run.
[[nodiscard]] Result<std::vector<ListedClash>> list_clashes(Database& database,
                                                            const ClashFilter& filter);

/// Returns clashes by the ids of their rows, in that order; ids that no row has are left out.
[[nodiscard]] Result<std::vector<ListedClash>> read_clashes(Database& database,
                                                            std::span<const std::int64_t> ids);

/// Returns the statuses that clashes had after an event, of those of which people changed it since.
[[nodiscard]] Result<std::map<std::int64_t, report::DecisionStatus>> statuses_at(
    Database& database, std::int64_t event);

/// What somebody decides.
struct ClashDecision {
  std::optional<report::DecisionStatus> status;  ///< absent: it stays
  std::optional<std::string> comment, assignee;  ///< absent: they stay; empty: none from now on
  std::string by, at;
};

/// Writes decisions about clashes, with statements that are prepared once. It knows the tests as
/// they were when it was made, and is used within one transaction.
class ClashDecider {
 public:
  [[nodiscard]] static Result<ClashDecider> of(Database& database);

  /// Writes a decision about clashes, with an event for each whose status or assignee changes or
  /// that is commented on. Returns how many rows changed. Errors: usage for a key that no clash
  /// has; nothing is to be committed then.
  [[nodiscard]] Result<std::uint64_t> decide(std::span<const std::string> keys,
                                             const ClashDecision& decision);

 private:
  ClashDecider(Database& database, std::map<std::int64_t, std::int64_t> last_runs, ClashRows rows);
  Result<bool> decide(const ClashRow& before, const ClashDecision& decision, std::int64_t run);

  Database* database_;
  std::map<std::int64_t, std::int64_t> last_runs_;  ///< of each test
  ClashRows rows_;
};

/// Writes one decision as ClashDecider does. To be called within a transaction.
[[nodiscard]] Result<std::uint64_t> decide(Database& database, std::span<const std::string> keys,
                                           const ClashDecision& decision);

/// A run of a test.
struct TrendRow {
  std::int64_t run = 0;
  std::string started, program, who, test, how;
  double seconds = 0;
  std::uint64_t objects = 0, changed_objects = 0, tested_pairs = 0, kept_results = 0;
  std::uint64_t hit = 0, contact = 0, clearance_violation = 0, allowed = 0;
  std::uint64_t appeared = 0, gone = 0;
  std::uint64_t fresh = 0, active = 0, reviewed = 0, approved = 0, resolved = 0, cannot_tell = 0;
};
/// Returns the runs in their order.
[[nodiscard]] Result<std::vector<TrendRow>> read_trend(Database& database);

/// Reads what happened to clashes, with a statement that is prepared once.
class ClashEvents {
 public:
  [[nodiscard]] static Result<ClashEvents> of(Database& database);

  /// Returns what happened to the clash of a row, in order.
  [[nodiscard]] Result<std::vector<ClashEvent>> read(std::int64_t clash);

 private:
  ClashEvents(Database& database, Statement select);
  Database* database_;
  Statement select_;
};

/// Returns what happened to a clash, in order. Errors: usage for a key that no clash has.
[[nodiscard]] Result<std::vector<ClashEvent>> read_events(Database& database,
                                                          const std::string& key);

}  // namespace strake::project
