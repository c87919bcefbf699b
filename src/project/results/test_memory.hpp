// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "project/results/clash_history.hpp"
#include "project/results/clash_rows.hpp"
#include "project/results/coverage.hpp"
#include "project/results/match_reports.hpp"
#include "project/results/remember.hpp"
#include "strake/core/hash.hpp"

namespace strake::project {

/// The clash of a result that somebody wrote into, or that came back, for reports.
struct ReportedClash {
  report::Reopened reopened = report::Reopened::no;
  ClashRow row;
};

/// A row that was not found by its key, and why this run cannot tell about it.
struct WaitingRow {
  ClashRow row;
  std::string why;
};

/// Takes the results of one test into the table `clash`: each result has a row, and each row is
/// told what this run says of it.
class TestMemory {
 public:
  /// What it is given must outlive it; `before` is null where the test was never run, `changes`
  /// where nothing shows what the run did to the results of that.
  TestMemory(Database& database, ClashRows& rows, ClashHistory& history, const model::Model& model,
             const RunFacts& facts, std::int64_t run, const TestedTest& test, TestRow row,
             const StoredTest* before, const clash::PairChanges* changes);

  [[nodiscard]] Status run(const parallel::Context& context);

  /// Returns the row of each result, 0 where a rule allows it and it has none.
  [[nodiscard]] const std::vector<std::int64_t>& rows() const { return match_.rows; }
  /// Whether the results are those stored, all of them.
  [[nodiscard]] bool is_unchanged() const { return is_unchanged_; }
  [[nodiscard]] const TestTrend& trend() const { return trend_; }
  /// Whether this run found the clash of a result for the first time, or again.
  [[nodiscard]] bool is_new(std::size_t pair) const { return is_new_[pair]; }
  /// Returns the results that is_new(), ascending.
  [[nodiscard]] std::vector<std::size_t> new_results() const;
  /// Returns what there is to be said of results, by their numbers.
  [[nodiscard]] const std::map<std::size_t, ReportedClash>& reported() const { return reported_; }
  /// Returns decided clashes that this run did not find and cannot tell about.
  [[nodiscard]] const std::vector<ClashRow>& not_found() const { return not_found_; }

 private:
  [[nodiscard]] Result<ReportMatch> match(const parallel::Context& context) const;
  [[nodiscard]] Result<bool> take_first(const parallel::Context& context);
  [[nodiscard]] Status take_match(const parallel::Context& context);
  [[nodiscard]] Status take_positional();
  [[nodiscard]] Status take_watched();
  [[nodiscard]] Result<std::vector<Hash128>> keys_of_new(const parallel::Context& context) const;
  [[nodiscard]] Status add_result(std::size_t pair, const Hash128& key);
  [[nodiscard]] Status add(std::size_t pair, const std::string& key);
  [[nodiscard]] Result<bool> insert(std::size_t pair, const std::string& key);
  [[nodiscard]] Status update_found(ClashRow row, std::size_t pair);
  [[nodiscard]] Status update_counted(ClashRow row, const clash::UnlistedContact& contact);
  [[nodiscard]] Status update_not_found(ClashRow row);
  [[nodiscard]] Status apply(const ClashRow& before, ClashRow& row, const Observation& observed,
                             std::optional<std::size_t> pair);
  [[nodiscard]] Status keep_history(const ClashRow& before, const ClashRow& row,
                                    const Observation& observed, bool has_result);
  [[nodiscard]] Status park(ClashRow& row);
  [[nodiscard]] Result<std::vector<ClashRow>> watched();
  [[nodiscard]] Result<ClashRow> existing(std::int64_t id);
  void wait(ClashRow row, std::string why);
  void describe(ClashRow& row, const clash::Pair& pair) const;
  [[nodiscard]] std::string key_of(const clash::Pair& pair) const;
  [[nodiscard]] bool is_positional(const clash::Pair& pair) const;
  [[nodiscard]] SoughtObject sought(const ClashSide& side) const;
  [[nodiscard]] const clash::Report* earlier_report() const;
  void keep_open_parts(const ClashRow& row, const clash::Pair& before);
  [[nodiscard]] Result<OpenParts> last_open_parts(const ClashRow& row);

  Database& database_;
  ClashRows& table_;
  ClashHistory& history_;
  const model::Model& model_;
  const RunFacts& facts_;
  std::int64_t run_;
  const TestedTest& test_;
  const clash::Report& report_;
  TestRow row_;
  const StoredTest* before_;
  const clash::PairChanges* changes_;
  bool is_unchanged_;
  Coverage coverage_;
  ReportMatch match_;
  std::vector<std::size_t> positional_results_;  ///< whose ids are positions, to be found by place
  std::vector<WaitingRow> waiting_;              ///< and the rows that they may be
  std::set<std::int64_t> handled_;  ///< rows that this run has dealt with, or that wait
  std::map<std::int64_t, OpenParts> open_before_;  ///< of rows whose results the run before had
  TestTrend trend_;
  std::vector<bool> is_new_;            ///< of each result
  std::vector<std::size_t> maybe_new_;  ///< all that may be, in any order
  std::map<std::size_t, ReportedClash> reported_;
  std::vector<ClashRow> not_found_;
};

}  // namespace strake::project
