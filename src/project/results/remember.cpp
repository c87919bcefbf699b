// SPDX-License-Identifier: Apache-2.0
#include "project/results/remember.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "project/results/positional_rows.hpp"
#include "project/results/test_memory.hpp"
#include "strake/core/version.hpp"

namespace strake::project {
namespace {

using report::DecisionStatus;

/// Returns what a test asks, for people.
std::string settings_text(const clash::Report& report) {
  const clash::Tolerances& t = report.options.tolerances;
  return fmt::format("a {}, b {}, clearance {:g} mm, touch gap {:g} mm, touch overlap {:g} mm",
                     report.set_a, report.set_b, t.clearance_mm, t.touch_gap_mm,
                     t.touch_overlap_mm);
}

Result<std::int64_t> add_run(Database& database, const RunFacts& facts) {
  Result<Statement> insert =
      database.prepare("INSERT INTO run (started, program, who, seconds) VALUES (?1, ?2, ?3, ?4)");
  if (!insert) return insert.error();
  insert->bind(1, std::string_view(facts.started)).bind(2, version());
  insert->bind(3, std::string_view(facts.who)).bind(4, facts.seconds);
  if (const Status status = insert->run(); !status) return status.error();
  return database.last_insert_id();
}

/// Adds the rows of a test that was never run; its results follow.
Result<TestRow> add_test(Database& database, const std::string& name, std::int64_t run) {
  Result<Statement> insert =
      database.prepare("INSERT INTO test (name, settings, run, objects) VALUES (?1, '', ?2, 0)");
  if (!insert) return insert.error();
  insert->bind(1, std::string_view(name)).bind(2, run);
  if (const Status status = insert->run(); !status) return status.error();
  const TestRow row{database.last_insert_id(), run, true};
  insert = database.prepare(
      "INSERT INTO report (test, snapshot, head, kept, seal) VALUES (?1, x'', x'', x'', x'')");
  if (!insert) return insert.error();
  if (const Status status = insert->bind(1, row.id).run(); !status) return status.error();
  return row;
}

Result<std::uint64_t> count_resolved(Database& database, std::int64_t test) {
  Result<Statement> select =
      database.prepare("SELECT count(*) FROM clash WHERE test = ?1 AND decision = 'resolved'");
  if (!select) return select.error();
  const Result<bool> there = select->bind(1, test).step();
  if (!there) return there.error();
  return static_cast<std::uint64_t>(select->integer(0));
}

/// Returns how many results are listed that no rule allows.
std::uint64_t count_listed(const clash::Report& report) {
  return report.count_hit + report.count_contact + report.count_clearance -
         report.unlisted.contacts;
}

/// The decisions of a run, which reports take as those of a file.
class DecidedBuilder {
 public:
  explicit DecidedBuilder(RememberedRun& run) : run_(run) {
    // Every clash that nobody decided about and that is not new has this one, which comes first.
    report::Decision active;
    active.status = DecisionStatus::active;
    add(std::move(active));
  }

  /// Of results that nobody wrote into and that are not new no list is made: they are active.
  void add_test(const clash::Report& report, const TestMemory& memory) {
    std::vector<report::DecidedResult>& results = run_.decided.tests.emplace_back();
    std::vector<std::pair<model::ObjectId, model::ObjectId>>& undecided =
        run_.decided.others.emplace_back().undecided;
    const std::size_t test = run_.decided.tests.size() - 1;
    const std::vector<std::size_t> new_ones = memory.new_results();
    std::uint64_t rest = count_listed(report);
    for (const std::size_t at : new_ones) {
      const clash::Pair& pair = report.pairs[at];
      if (pair.allowed >= 0 || memory.reported().contains(at)) continue;
      undecided.emplace_back(pair.a, pair.b);
      count(DecisionStatus::undecided, rest);
    }
    for (const auto& [at, reported] : memory.reported()) {
      const clash::Pair& pair = report.pairs[at];
      results.push_back(
          {pair.a, pair.b, pair.cls, pair.allowed >= 0, reported.reopened, false, nullptr});
      reported_.push_back(
          {test, results.size() - 1, add(reported_decision(reported, memory.is_new(at), report))});
      decision_of_.emplace(reported.row.id, reported_.back().decision);
      if (pair.allowed < 0) count(decisions_.back().status, rest);
    }
    run_.decided.counts[static_cast<std::size_t>(DecisionStatus::active)] += rest;
    for (const ClashRow& row : memory.not_found())
      not_found_.push_back(add(decision_of(row, report.name)));
  }

  /// Adds all that people said of the clashes that decisions are about.
  Status add_comments(Database& database, RunComments comments) {
    Result<Statement> select = database.prepare(
        fmt::format("SELECT clash,{} FROM {} WHERE run IS NULL AND comment <> '' ORDER BY id",
                    kEventColumns, kEventTables));
    if (!select) return select.error();
    for (;;) {
      const Result<bool> there = select->step();
      if (!there) return there.error();
      if (!*there) return {};
      const auto at = decision_of_.find(select->integer(0));
      if (at == decision_of_.end()) continue;
      const Result<ClashEvent> event = event_of(database, *select);
      if (!event) return event.error();
      report::DecisionComment comment = event->person_comment();
      if (comments == RunComments::with_history) comment.text = event->comment;
      if (!comment.text.empty()) decisions_[at->second].comments.push_back(std::move(comment));
    }
  }

  void finish(const std::string& name, double deeper_mm) {
    run_.file = std::make_unique<report::DecisionFile>();
    run_.file->name = name;
    run_.file->decisions = std::move(decisions_);
    const std::vector<report::Decision>& decisions = run_.file->decisions;
    report::DecidedResults& decided = run_.decided;
    decided.file = run_.file.get();
    decided.deeper_mm = deeper_mm;
    for (report::OtherResults& rest : decided.others) rest.result.decision = decisions.data();
    for (const ReportedResult& reported : reported_)
      decided.tests[reported.test][reported.result].decision = &decisions[reported.decision];
    for (const std::size_t at : not_found_) decided.not_found.push_back(&decisions[at]);
  }

 private:
  /// A result that has a decision of its own, which get their places in the end.
  struct ReportedResult {
    std::size_t test = 0, result = 0, decision = 0;
  };

  /// Counts one of the results that are left.
  void count(DecisionStatus status, std::uint64_t& rest) {
    ++run_.decided.counts[static_cast<std::size_t>(status)];
    --rest;
  }

  std::size_t add(report::Decision decision) {
    decisions_.push_back(std::move(decision));
    return decisions_.size() - 1;
  }

  [[nodiscard]] static report::Decision reported_decision(const ReportedClash& reported,
                                                          bool is_new,
                                                          const clash::Report& report) {
    report::Decision decision = decision_of(reported.row, report.name);
    if (decision.status == DecisionStatus::undecided && !is_new)
      decision.status = DecisionStatus::active;
    return decision;
  }

  RememberedRun& run_;
  std::vector<report::Decision> decisions_;
  std::vector<ReportedResult> reported_;
  std::map<std::int64_t, std::size_t> decision_of_;  ///< by the row of the clash
  std::vector<std::size_t> not_found_;
};

Status add_trend(Database& database, std::int64_t run, std::int64_t test, const TestedTest& tested,
                 const TestTrend& trend, const std::array<std::uint64_t, 5>& statuses) {
  Result<Statement> insert = database.prepare(
      "INSERT INTO run_test (run, test, how, objects, changed_objects, tested_pairs, kept_results, "
      "hit, contact, clearance_violation, allowed, appeared, gone, new, active, reviewed, "
      "approved, resolved, cannot_tell) VALUES "
      "(?1,?2,?3,?4,?5,?6,?7,?8,?9,?10,?11,?12,?13,?14,?15,?16,?17,?18,?19)");
  if (!insert) return insert.error();
  const clash::Report& report = *tested.report;
  insert->bind(1, run).bind(2, test).bind(3, name(tested.work.how));
  int p = 4;
  for (const std::uint64_t value :
       {tested.work.objects, tested.work.changed_objects, tested.work.tested_pairs,
        tested.work.kept_results, report.count_hit, report.count_contact, report.count_clearance,
        report.count_allowed, trend.appeared, trend.gone, statuses[0], statuses[1], statuses[2],
        statuses[3], trend.resolved, trend.cannot_tell})
    insert->bind(p++, static_cast<std::int64_t>(value));
  return insert->run();
}

/// Remembers the tests of one run.
class RunMemory {
 public:
  RunMemory(Database& database, ClashRows rows, ClashHistory history, const model::Model& model,
            const RunFacts& facts, RememberedRun& run)
      : database_(database),
        rows_(std::move(rows)),
        history_(std::move(history)),
        model_(model),
        facts_(facts),
        run_(run),
        decided_(run) {}

  Status add(const TestedTest& test, const parallel::Context& context) {
    const std::string& name = test.report->name;
    Result<std::optional<TestRow>> row = find_test(database_, name);
    if (!row) return row.error();
    if (!*row) {
      Result<TestRow> added = add_test(database_, name, run_.number);
      if (!added) return added.error();
      return add(test, *added, nullptr, nullptr, context);
    }
    if (test.before != nullptr && test.before->run == (**row).run)
      return add(test, **row, test.before, test.changes, context);
    // Another process remembered a run meanwhile: this one follows that.
    Result<std::optional<StoredTest>> before = read_test(database_, name, context);
    if (!before) return before.error();
    return add(test, **row, *before ? &**before : nullptr, nullptr, context);
  }

  Status finish() {
    if (facts_.comments != RunComments::none)
      if (const Status status = decided_.add_comments(database_, facts_.comments); !status)
        return status;
    decided_.finish(database_.file().filename().string(), facts_.deeper_mm);
    return {};
  }

 private:
  Status add(const TestedTest& test, TestRow row, const StoredTest* before,
             const clash::PairChanges* changes, const parallel::Context& context) {
    TestMemory memory(database_, rows_, history_, model_, facts_, run_.number, test, row, before,
                      changes);
    if (const Status status = memory.run(context); !status) return status;
    const std::array<std::uint64_t, 5> counted = run_.decided.counts;
    decided_.add_test(*test.report, memory);
    std::array<std::uint64_t, 5> statuses = run_.decided.counts;
    for (std::size_t s = 0; s < statuses.size(); ++s) statuses[s] -= counted[s];
    const TestToWrite written{row.id,
                              run_.number,
                              settings_text(*test.report),
                              *test.snapshot,
                              {*test.report, memory.rows()},
                              memory.is_unchanged(),
                              changes};
    if (const Status status = write_test(database_, written, before, context); !status)
      return status;
    const bool are_known =
        memory.is_unchanged() ||
        (before != nullptr && is_same_known(before->snapshot.names, test.snapshot->names));
    if (const Status status = write_test_objects(database_, row.id, model_, are_known); !status)
      return status;
    if (const Status status =
            write_run_result(database_, run_.number,
                             {row.id, test.report->name, written.settings, test.report->hash});
        !status)
      return status;
    TestTrend trend = memory.trend();
    const Result<std::uint64_t> resolved = count_resolved(database_, row.id);
    if (!resolved) return resolved.error();
    trend.resolved = *resolved;
    run_.trends.push_back(trend);
    return add_trend(database_, run_.number, row.id, test, trend, statuses);
  }

  Database& database_;
  ClashRows rows_;
  ClashHistory history_;
  const model::Model& model_;
  const RunFacts& facts_;
  RememberedRun& run_;
  DecidedBuilder decided_;
};

}  // namespace

std::string_view name(Retested how) {
  switch (how) {
    case Retested::full:
      return "full";
    case Retested::changes:
      return "changes";
    case Retested::nothing:
      break;
  }
  return "nothing";
}

Result<RememberedRun> remember(Database& database, const model::Model& model, const RunFacts& facts,
                               std::span<const TestedTest> tests,
                               const parallel::Context& context) {
  Result<ClashRows> rows = ClashRows::of(database);
  if (!rows) return rows.error();
  Result<ClashHistory> history = ClashHistory::of(database);
  if (!history) return history.error();
  RememberedRun run;
  const Result<std::int64_t> number = add_run(database, facts);
  if (!number) return number.error();
  run.number = *number;
  RunMemory memory(database, std::move(*rows), std::move(*history), model, facts, run);
  for (const TestedTest& test : tests)
    if (const Status status = memory.add(test, context); !status) return status.error();
  if (const Status status = memory.finish(); !status) return status.error();
  if (const Status status = write_run_record(database, run.number, {facts.rules, facts.grouping});
      !status)
    return status.error();
  return run;
}

}  // namespace strake::project
