// SPDX-License-Identifier: Apache-2.0
#include "project/history/kept_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>

#include "core/text_encoding.hpp"

namespace strake::project {
namespace {

/// The runs that are kept, by number.
class KeptRuns {
 public:
  static Result<KeptRuns> read(Database& database, const std::optional<std::string>& test) {
    KeptRuns kept(database);
    Result<Statement> select =
        database.prepare("SELECT id, id IN (SELECT run FROM run_report) FROM run ORDER BY id");
    if (!select) return select.error();
    for (;;) {
      const Result<bool> there = select->step();
      if (!there) return there.error();
      if (!*there) return kept;
      const std::int64_t number = select->integer(0);
      if (select->integer(1) == 0) {
        kept.not_kept_.push_back(number);
        continue;
      }
      Result<std::vector<RunResult>> tests = read_run_results(database, number);
      if (!tests) return tests.error();
      if (test) std::erase_if(*tests, [&](const RunResult& t) { return t.name != *test; });
      kept.runs_.push_back({number, {}, std::move(*tests)});
    }
  }

  /// Finds a run that somebody requested.
  [[nodiscard]] Result<KeptRun> find(std::int64_t number,
                                     const std::optional<std::string>& test) const {
    const auto at = std::ranges::find(runs_, number, &KeptRun::number);
    if (at == runs_.end()) return no_run(number);
    if (at->tests.empty() && test)
      return Error{ErrorCode::usage,
                   fmt::format("run {} did not run test {}", number, in_quotes(*test)),
                   {},
                   "it was run in " + numbers()};
    return with_record(*at);
  }

  /// Returns the last run of the tests, and the one before it that ran one of them.
  [[nodiscard]] Result<std::pair<KeptRun, KeptRun>> last_two() const {
    const auto ran = [](const KeptRun& run) { return !run.tests.empty(); };
    const auto last = std::find_if(runs_.rbegin(), runs_.rend(), ran);
    if (last == runs_.rend()) return too_few();
    const auto shares = [&](const KeptRun& run) {
      return std::ranges::any_of(run.tests, [&](const RunResult& test) {
        return std::ranges::find(last->tests, test.test, &RunResult::test) != last->tests.end();
      });
    };
    const auto before = std::find_if(last + 1, runs_.rend(), shares);
    if (before == runs_.rend()) return too_few();
    Result<KeptRun> first = with_record(*before);
    if (!first) return first.error();
    Result<KeptRun> second = with_record(*last);
    if (!second) return second.error();
    return std::pair(std::move(*first), std::move(*second));
  }

 private:
  explicit KeptRuns(Database& database) : database_(&database) {}

  [[nodiscard]] Result<KeptRun> with_record(KeptRun run) const {
    Result<std::optional<RunRecord>> record = read_run_record(*database_, run.number);
    if (!record) return record.error();
    if (!*record)
      return database_->damaged(fmt::format("there is no record of run {}", run.number));
    run.record = std::move(**record);
    return run;
  }

  /// The numbers of the runs that ran the tests.
  [[nodiscard]] std::string numbers() const {
    std::string text;
    for (const KeptRun& run : runs_)
      if (!run.tests.empty()) text += (text.empty() ? "" : ", ") + std::to_string(run.number);
    return text.empty() ? "none" : text;
  }

  [[nodiscard]] Error no_run(std::int64_t number) const {
    if (std::ranges::find(not_kept_, number) == not_kept_.end())
      return {ErrorCode::usage,
              fmt::format("there is no run {}", number),
              {},
              "'strake clash history' has their numbers"};
    return {ErrorCode::usage,
            fmt::format("run {} cannot be compared: an earlier version of Strake remembered it, "
                        "and what it said of each clash is not known",
                        number),
            {},
            "later runs can be: " + numbers()};
  }

  [[nodiscard]] Error too_few() const {
    const bool is_old = !not_kept_.empty();
    return {ErrorCode::usage,
            is_old ? "there are no two runs that can be compared: what those of an earlier version "
                     "of Strake said of each clash is not known"
                   : "there are no two runs of the same test",
            {},
            "'strake clash -p' makes one more"};
  }

  Database* database_;
  std::vector<KeptRun> runs_;           ///< by number
  std::vector<std::int64_t> not_kept_;  ///< runs of an earlier version of the tables
};

Status check_test_name(Database& database, const std::string& name) {
  Result<Statement> select = database.prepare("SELECT name FROM test ORDER BY id");
  if (!select) return select.error();
  std::string names;
  for (;;) {
    const Result<bool> there = select->step();
    if (!there) return there.error();
    if (!*there) break;
    if (select->text(0) == name) return {};
    names += (names.empty() ? "there are " : ", ") + in_quotes(select->text(0));
  }
  return Error{ErrorCode::usage,
               "no test is called " + in_quotes(name),
               {},
               names.empty() ? "'strake clash -p' runs tests" : names};
}

}  // namespace

Result<std::pair<KeptRun, KeptRun>> runs_to_compare(Database& database,
                                                    const ComparedRuns& request) {
  if (request.test)
    if (const Status status = check_test_name(database, *request.test); !status)
      return status.error();
  const Result<KeptRuns> kept = KeptRuns::read(database, request.test);
  if (!kept) return kept.error();
  if (!request.runs) return kept->last_two();
  if (request.runs->first >= request.runs->second)
    return Error{ErrorCode::usage, "the earlier run comes first", "--runs", "as --runs 3 7"};
  Result<KeptRun> first = kept->find(request.runs->first, request.test);
  if (!first) return first.error();
  Result<KeptRun> second = kept->find(request.runs->second, request.test);
  if (!second) return second.error();
  return std::pair(std::move(*first), std::move(*second));
}

}  // namespace strake::project
