// SPDX-License-Identifier: Apache-2.0
#include "project/results/clash_queries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "core/text_encoding.hpp"

namespace strake::project {
namespace {

using report::DecisionStatus;

struct TestName {
  std::string name;
  std::int64_t run = 0;
};

Result<std::map<std::int64_t, TestName>> tests_of(Database& database) {
  Result<Statement> select = database.prepare("SELECT id, name, run FROM test");
  if (!select) return select.error();
  std::map<std::int64_t, TestName> tests;
  for (;;) {
    const Result<bool> there = select->step();
    if (!there) return there.error();
    if (!*there) return tests;
    tests[select->integer(0)] = {std::string(select->text(1)), select->integer(2)};
  }
}

Error no_clash(const std::string& key) {
  return {ErrorCode::usage,
          "no clash has the key " + in_quotes(key),
          {},
          "'strake clash list' has the keys"};
}

/// Errors: usage where no test has the name.
Status check_test(const std::map<std::int64_t, TestName>& tests, const std::string& wanted) {
  std::string names;
  for (const auto& [id, test] : tests) {
    if (test.name == wanted) return {};
    names += (names.empty() ? "" : ", ") + in_quotes(test.name);
  }
  return Error{ErrorCode::usage,
               "no test is called " + in_quotes(wanted),
               {},
               names.empty() ? "'strake clash -p' runs tests" : "there are " + names};
}

/// Returns what somebody said and did besides the status, for people.
std::string event_text(const ClashRow& before, const ClashRow& after,
                       const ClashDecision& decision) {
  std::string text = decision.comment.value_or(std::string());
  const auto add = [&](const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
  if (after.comment.empty() && !before.comment.empty()) add("the comment is taken back");
  if (after.assignee != before.assignee)
    add(after.assignee.empty() ? "assigned to nobody" : "assigned to " + after.assignee);
  return text;
}

/// Returns a decision as tables have it: its texts are UTF-8.
ClashDecision as_stored(ClashDecision decision) {
  decision.by = valid_utf8(decision.by);
  for (std::optional<std::string>* const text : {&decision.comment, &decision.assignee})
    if (*text) *text = valid_utf8(**text);
  return decision;
}

/// Returns a row as somebody decides it to be.
ClashRow decided(ClashRow row, const ClashDecision& decision, std::int64_t last_run) {
  if (decision.comment) row.comment = *decision.comment;
  if (decision.assignee) row.assignee = *decision.assignee;
  if (!decision.status) return row;
  row.decision = *decision.status;
  row.decided.reset();
  row.decided_by = decision.by;
  row.decided_at = decision.at;
  if (row.decision == DecisionStatus::approved) row.decided = row.now;
  if (row.decision == DecisionStatus::undecided) {
    row.new_run = last_run;
    row.decided_by.clear();
    row.decided_at.clear();
  }
  return row;
}

std::uint64_t count_at(const Statement& at, int column) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(at.integer(column), 0));
}

TrendRow trend_at(const Statement& at) {
  TrendRow row;
  row.run = at.integer(0);
  int column = 1;
  for (std::string* const text : {&row.started, &row.program, &row.who, &row.test, &row.how})
    *text = at.text(column++);
  row.seconds = at.real(column++);
  for (std::uint64_t* const count :
       {&row.objects, &row.changed_objects, &row.tested_pairs, &row.kept_results, &row.hit,
        &row.contact, &row.clearance_violation, &row.allowed, &row.appeared, &row.gone, &row.fresh,
        &row.active, &row.reviewed, &row.approved, &row.resolved, &row.cannot_tell})
    *count = count_at(at, column++);
  return row;
}

std::optional<DecisionStatus> status_of(std::string_view word) {
  const auto at = std::ranges::find_if(report::kDecisionStatuses,
                                       [&](DecisionStatus s) { return name(s) == word; });
  return at == report::kDecisionStatuses.end() ? std::nullopt : std::optional(*at);
}

}  // namespace

Result<std::vector<ListedClash>> list_clashes(Database& database, const ClashFilter& filter) {
  const Result<std::map<std::int64_t, TestName>> tests = tests_of(database);
  if (!tests) return tests.error();
  if (filter.test)
    if (const Status status = check_test(*tests, *filter.test); !status) return status.error();
  Result<Statement> select =
      database.prepare("SELECT " + std::string(kClashColumns) + " FROM clash ORDER BY test, id");
  if (!select) return select.error();
  std::vector<ListedClash> all;
  for (;;) {
    const Result<bool> there = select->step();
    if (!there) return there.error();
    if (!*there) return all;
    Result<ClashRow> row = row_of(database, *select);
    if (!row) return row.error();
    const auto test = tests->find(row->test);
    if (test == tests->end()) return database.damaged("a clash is of no test");
    const DecisionStatus status = row->status(test->second.run);
    if ((filter.status && *filter.status != status) ||
        (filter.test && *filter.test != test->second.name))
      continue;
    all.push_back({std::move(*row), test->second.name, status, test->second.run});
  }
}

Result<std::vector<ListedClash>> read_clashes(Database& database,
                                              std::span<const std::int64_t> ids) {
  const Result<std::map<std::int64_t, TestName>> tests = tests_of(database);
  if (!tests) return tests.error();
  Result<ClashRows> rows = ClashRows::of(database);
  if (!rows) return rows.error();
  std::vector<ListedClash> found;
  for (const std::int64_t id : ids) {
    Result<std::optional<ClashRow>> row = rows->find(id);
    if (!row) return row.error();
    if (!*row) continue;
    const auto test = tests->find((**row).test);
    if (test == tests->end()) return database.damaged("a clash is of no test");
    const DecisionStatus status = (**row).status(test->second.run);
    found.push_back({std::move(**row), test->second.name, status, test->second.run});
  }
  return found;
}

Result<std::map<std::int64_t, report::DecisionStatus>> statuses_at(Database& database,
                                                                   std::int64_t event) {
  Result<Statement> select =
      database.prepare("SELECT clash, before FROM event WHERE id > ?1 AND run IS NULL ORDER BY id");
  if (!select) return select.error();
  select->bind(1, event);
  std::map<std::int64_t, DecisionStatus> statuses;
  for (;;) {
    const Result<bool> there = select->step();
    if (!there) return there.error();
    if (!*there) return statuses;
    const auto before = status_of(select->text(1));
    if (!before) return database.damaged("an event has a status that is none");
    // The first event that came later is about what was until then.
    statuses.try_emplace(select->integer(0), *before);
  }
}

ClashDecider::ClashDecider(Database& database, std::map<std::int64_t, std::int64_t> last_runs,
                           ClashRows rows)
    : database_(&database), last_runs_(std::move(last_runs)), rows_(std::move(rows)) {}

Result<ClashDecider> ClashDecider::of(Database& database) {
  const Result<std::map<std::int64_t, TestName>> tests = tests_of(database);
  if (!tests) return tests.error();
  Result<ClashRows> rows = ClashRows::of(database);
  if (!rows) return rows.error();
  std::map<std::int64_t, std::int64_t> last_runs;
  for (const auto& [id, test] : *tests) last_runs.emplace(id, test.run);
  return ClashDecider(database, std::move(last_runs), std::move(*rows));
}

Result<std::uint64_t> ClashDecider::decide(std::span<const std::string> keys,
                                           const ClashDecision& decision) {
  const ClashDecision stored = as_stored(decision);
  std::uint64_t changed = 0;
  for (const std::string& key : keys) {
    const Result<std::optional<ClashRow>> known = rows_.find(std::string_view(key));
    if (!known) return known.error();
    if (!*known) return no_clash(key);
    const auto run = last_runs_.find((**known).test);
    if (run == last_runs_.end()) return database_->damaged("a clash is of no test");
    const Result<bool> done = decide(**known, stored, run->second);
    if (!done) return done.error();
    if (*done) ++changed;
  }
  return changed;
}

/// Decides about one clash. Returns whether its row changed.
Result<bool> ClashDecider::decide(const ClashRow& before, const ClashDecision& decision,
                                  std::int64_t run) {
  const ClashRow after = decided(before, decision, run);
  if (after == before) return false;
  if (const Status status = rows_.update(after); !status) return status.error();
  ClashEvent event{before.id,
                   std::nullopt,
                   decision.at,
                   decision.by,
                   before.status(run),
                   after.status(run),
                   event_text(before, after, decision)};
  const std::string typed = decision.comment.value_or(std::string());
  if (event.comment != typed) event.original = OriginalComment{.text = typed};
  if (event.before == event.after && event.comment.empty()) return true;
  if (const Status status = rows_.add(event); !status) return status.error();
  return true;
}

Result<std::uint64_t> decide(Database& database, std::span<const std::string> keys,
                             const ClashDecision& decision) {
  Result<ClashDecider> decider = ClashDecider::of(database);
  if (!decider) return decider.error();
  return decider->decide(keys, decision);
}

Result<std::vector<TrendRow>> read_trend(Database& database) {
  Result<Statement> select = database.prepare(
      "SELECT run.id, started, program, who, test.name, how, seconds, run_test.objects, "
      "changed_objects, tested_pairs, kept_results, hit, contact, clearance_violation, allowed, "
      "appeared, gone, new, active, reviewed, approved, resolved, cannot_tell FROM run_test "
      "JOIN run ON run.id = run_test.run JOIN test ON test.id = run_test.test "
      "ORDER BY run.id, test.id");
  if (!select) return select.error();
  std::vector<TrendRow> rows;
  for (;;) {
    const Result<bool> there = select->step();
    if (!there) return there.error();
    if (!*there) return rows;
    rows.push_back(trend_at(*select));
  }
}

Result<std::vector<ClashEvent>> read_events(Database& database, const std::string& key) {
  Result<ClashRows> rows = ClashRows::of(database);
  if (!rows) return rows.error();
  const Result<std::optional<ClashRow>> row = rows->find(std::string_view(key));
  if (!row) return row.error();
  if (!*row) return no_clash(key);
  Result<ClashEvents> events = ClashEvents::of(database);
  if (!events) return events.error();
  return events->read((**row).id);
}

ClashEvents::ClashEvents(Database& database, Statement select)
    : database_(&database), select_(std::move(select)) {}

Result<ClashEvents> ClashEvents::of(Database& database) {
  Result<Statement> select = database.prepare(fmt::format(
      "SELECT clash,{} FROM {} WHERE clash = ?1 ORDER BY id", kEventColumns, kEventTables));
  if (!select) return select.error();
  return ClashEvents(database, std::move(*select));
}

Result<std::vector<ClashEvent>> ClashEvents::read(std::int64_t clash) {
  select_.reset();
  select_.bind(1, clash);
  std::vector<ClashEvent> events;
  for (;;) {
    const Result<bool> there = select_.step();
    if (!there) return there.error();
    if (!*there) break;
    Result<ClashEvent> event = event_of(*database_, select_);
    if (!event) return event.error();
    events.push_back(std::move(*event));
  }
  select_.reset();
  return events;
}

}  // namespace strake::project
