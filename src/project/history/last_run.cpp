// SPDX-License-Identifier: Apache-2.0
#include "project/history/last_run.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "project/results/positional_rows.hpp"
#include "project/results/stored_tests.hpp"

namespace strake::project {
namespace {

Error no_names(const Database& database) {
  return {ErrorCode::usage,
          "its last result is of an earlier version of Strake, and not known with the names of all "
          "objects",
          database.file().string(), "run 'strake clash -p' once more"};
}

/// Adds what is decided about the results of a test; `decision_of_row` has the places of decisions.
void add_test(const clash::Report& report, const std::vector<std::int64_t>& rows,
              const std::map<std::int64_t, std::size_t>& decision_of_row, DecisionsOfNow& now) {
  std::vector<report::DecidedResult>& results = now.decided.tests.emplace_back();
  for (std::size_t i = 0; i < report.pairs.size(); ++i) {
    const clash::Pair& pair = report.pairs[i];
    const bool is_allowed = pair.allowed >= 0;
    const auto at = now.clashes.find(rows[i]);
    const bool is_listed =
        at != now.clashes.end() &&
        (at->second.row.is_touched() ||
         (!is_allowed && at->second.status != report::DecisionStatus::undecided));
    const auto status = is_listed ? at->second.status : report::DecisionStatus::undecided;
    if (!is_allowed) ++now.decided.counts[static_cast<std::size_t>(status)];
    if (is_listed)
      results.push_back({pair.a, pair.b, pair.cls, is_allowed, report::Reopened::no, false,
                         &now.file->decisions[decision_of_row.at(rows[i])]});
  }
}

}  // namespace

Error no_result(const Database& database) {
  return {ErrorCode::usage, "has no result of a clash test", database.file().string(),
          "'strake clash -p' makes one"};
}

Result<LastRun> read_last_run(Database& database, const std::vector<std::string>& tests,
                              const parallel::Context& context) {
  LastRun run;
  for (const std::string& name : tests) {
    Result<std::optional<StoredTest>> stored = read_test(database, name, context);
    if (!stored) return stored.error();
    if (!*stored) return no_result(database);
    StoredTest& test = **stored;
    Result<std::optional<model::Model>> model = read_test_objects(database, test);
    if (!model) return model.error();
    if (!*model) return no_names(database);
    if (!run.findings.tests.empty() && (**model).objects.size() != run.model.objects.size())
      return database.damaged("the tests of one run are of different models");
    run.model = std::move(**model);
    test.results.report.name = name;
    run.rows.push_back(std::move(test.results.rows));
    run.number = std::max(run.number, test.run);
    run.findings.tests.push_back(std::move(test.results.report));
    Result<std::optional<RunRecord>> record = read_run_record(database, test.run);
    if (!record) return record.error();
    run.record = std::move(*record);
  }
  return run;
}

Result<DecisionsOfNow> decisions_of_now(Database& database, const LastRun& run) {
  Result<std::vector<ListedClash>> listed = list_clashes(database, {});
  if (!listed) return listed.error();
  DecisionsOfNow now;
  now.file = std::make_unique<report::DecisionFile>();
  std::map<std::int64_t, std::size_t> decision_of_row;
  for (ListedClash& clash : *listed) {
    report::Decision decision = decision_of(clash.row, clash.test);
    decision.status = clash.status;
    decision_of_row.emplace(clash.row.id, now.file->decisions.size());
    now.file->decisions.push_back(std::move(decision));
    const std::int64_t id = clash.row.id;
    now.clashes.emplace(id, std::move(clash));
  }
  now.file->name = database.file().filename().string();
  now.decided.file = now.file.get();
  now.decided.deeper_mm = report::DecisionRules{}.deeper_mm;
  for (std::size_t t = 0; t < run.findings.tests.size(); ++t)
    add_test(run.findings.tests[t], run.rows[t], decision_of_row, now);
  return now;
}

}  // namespace strake::project
