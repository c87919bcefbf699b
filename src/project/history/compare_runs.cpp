// SPDX-License-Identifier: Apache-2.0
#include "project/history/compare_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

#include "clash/results/clash_key.hpp"
#include "project/history/kept_runs.hpp"
#include "project/history/observations.hpp"
#include "report/text/formatting.hpp"

namespace strake::project {
namespace {

/// Makes one of the two documents, whose results are named by their numbers until it is finished.
class DocumentOfRun {
 public:
  DocumentOfRun(report::ClashDocument& document, const KeptRun& run, const std::string& project)
      : document_(document) {
    document.name = fmt::format("{}, run {}", project, run.number);
    clash::Findings hashed;
    for (const RunResult& test : run.tests) {
      clash::Report& report = hashed.tests.emplace_back();
      report.name = test.name;
      report.hash = test.hash;
      report::DocumentTest& document_test = document.tests.emplace_back();
      document_test.name = test.name;
      document_test.hash = test.hash;
    }
    document.hash = clash::hash_of(hashed);
    if (const auto& rules = run.record.rules)
      document.made_by = {rules->file, rules->hash.text(), rules->profile};
  }

  /// Returns the number of the result.
  std::size_t add(const ClashRow& row, const Measure& measured, std::uint32_t test) {
    report::DocumentResult& result = document_.results.emplace_back();
    // A key that gave way to another clash has a mark and a number behind it.
    const std::string_view key = std::string_view(row.key).substr(0, row.key.find('~'));
    result.key = clash::parse_key(key).value_or(Hash128{});
    result.d_mm = measured.d_mm;
    result.point_mm = row.point_mm;
    result.test = test;
    result.a = object(row.a);
    result.b = object(row.b);
    result.regions = measured.regions;
    result.cls = measured.cls;
    return document_.results.size() - 1;
  }

 private:
  std::uint32_t object(const ClashSide& side) {
    const auto [at, is_new] = numbers_.try_emplace(
        std::pair(side.file, side.id), static_cast<std::uint32_t>(document_.objects.size()));
    if (is_new) document_.objects.push_back({kept(side.id), kept(side.name), kept(side.file)});
    return at->second;
  }

  std::string_view kept(const std::string& text) {
    auto& room = document_.texts.emplace_back(std::make_unique<char[]>(text.size()));
    std::ranges::copy(text, room.get());
    return {room.get(), text.size()};
  }

  report::ClashDocument& document_;
  std::map<std::pair<std::string, std::string>, std::uint32_t> numbers_;
};

Result<ResultCounts> counts_of(Database& database, std::int64_t run, std::int64_t test) {
  Result<Statement> select = database.prepare(
      "SELECT hit, contact, clearance_violation, allowed FROM run_test WHERE run = ?1 AND test = "
      "?2");
  if (!select) return select.error();
  const Result<bool> there = select->bind(1, run).bind(2, test).step();
  if (!there) return there.error();
  if (!*there) return database.damaged(fmt::format("run {} has no counts of a test", run));
  ResultCounts counts;
  int column = 0;
  for (std::uint64_t* const count :
       {&counts.hit, &counts.contact, &counts.clearance_violation, &counts.allowed})
    *count = static_cast<std::uint64_t>(std::max<std::int64_t>(select->integer(column++), 0));
  return counts;
}

/// Fills a comparison with the clashes of its tests.
class RunComparer {
 public:
  RunComparer(Database& database, const KeptRun& before, const KeptRun& after, RunComparison& made)
      : database_(database),
        runs_{before.number, after.number},
        made_(made),
        before_(made.before, before, database.file().filename().string()),
        after_(made.after, after, database.file().filename().string()) {
    made.diff.before = &made.before;
    made.diff.after = &made.after;
  }

  Status run(const KeptRun& before, const KeptRun& after) {
    Result<Observations> observations = Observations::of(database_);
    if (!observations) return observations.error();
    for (std::uint32_t t = 0; t < after.tests.size(); ++t) {
      const RunResult& now = after.tests[t];
      const auto then = std::ranges::find(before.tests, now.test, &RunResult::test);
      if (then == before.tests.end()) {
        made_.diff.tests_added.push_back(now.name);
        const ObservationAt none{ObservationAt::Kind::not_known, {}, no_test(now)};
        const Status status = observations->each(
            now.test, runs_, [&](const ClashRow& row, const ObservationPair& observed) {
              return add(*observations, row, {none, observed.second}, 0, t);
            });
        if (!status) return status;
        continue;
      }
      compare_settings(*then, now);
      if (const Status status = count(*then, now); !status) return status;
      const auto of_before = static_cast<std::uint32_t>(then - before.tests.begin());
      const Status status = observations->each(
          now.test, runs_, [&](const ClashRow& row, const ObservationPair& observed) {
            return add(*observations, row, observed, of_before, t);
          });
      if (!status) return status;
    }
    for (std::uint32_t t = 0; t < before.tests.size(); ++t) {
      const RunResult& then = before.tests[t];
      if (std::ranges::find(after.tests, then.test, &RunResult::test) != after.tests.end())
        continue;
      made_.diff.tests_gone.push_back(then.name);
      const ObservationAt none{ObservationAt::Kind::cannot_tell, {}, no_test(then)};
      const Status status = observations->each(
          then.test, runs_, [&](const ClashRow& row, const ObservationPair& observed) {
            return add(*observations, row, {observed.first, none}, t, 0);
          });
      if (!status) return status;
    }
    finish();
    return {};
  }

 private:
  /// An entry whose results are not where they will be.
  struct Entry {
    std::vector<report::DiffEntry>* list = nullptr;  ///< null: still there
    std::optional<std::size_t> before, after;
    std::string why;
  };

  static std::string no_test(const RunResult& test) {
    return "there is no test '" + test.name + "'";
  }

  /// Takes what both runs counted in a test.
  Status count(const RunResult& then, const RunResult& now) {
    const Result<ResultCounts> before = counts_of(database_, runs_.first, then.test);
    if (!before) return before.error();
    const Result<ResultCounts> after = counts_of(database_, runs_.second, now.test);
    if (!after) return after.error();
    made_.counts.push_back({now.name, *before, *after});
    return {};
  }

  void compare_settings(const RunResult& then, const RunResult& now) {
    if (then.settings == now.settings) return;
    const auto quoted = [](const std::string& text) {
      std::string out;
      report::append_json(out, text);
      return out;
    };
    made_.diff.settings.push_back(
        {now.name, "settings", quoted(then.settings), quoted(now.settings)});
  }

  Status add(Observations& observations, const ClashRow& row, const ObservationPair& observed,
             std::uint32_t test_before, std::uint32_t test_after) {
    const auto& [then, now] = observed;
    const bool was = then.kind == ObservationAt::Kind::found,
               is = now.kind == ObservationAt::Kind::found;
    if (!was && !is) return {};
    Entry& entry = entries_.emplace_back();
    if (was) entry.before = before_.add(row, then.now, test_before);
    if (is) entry.after = after_.add(row, now.now, test_after);
    if (was && is) return {};
    const ObservationAt& other = was ? now : then;
    if (other.kind != ObservationAt::Kind::gone) {
      entry.why = other.why;
    } else {
      Result<std::string> rule = observations.allowed_by(row.id, was ? runs_.second : runs_.first);
      if (!rule) return rule.error();
      entry.why = std::move(*rule);
    }
    entry.list = is ? &made_.diff.added
                    : (other.kind == ObservationAt::Kind::cannot_tell ? &made_.diff.cannot_tell
                                                                      : &made_.diff.gone);
    return {};
  }

  /// All results are where they will be.
  void finish() {
    for (Entry& entry : entries_) {
      report::DiffEntry entry_of_diff;
      if (entry.before) entry_of_diff.before = &made_.before.results[*entry.before];
      if (entry.after) entry_of_diff.after = &made_.after.results[*entry.after];
      entry_of_diff.why = std::move(entry.why);
      if (entry.list == nullptr)
        made_.diff.add_still_there(std::move(entry_of_diff));
      else
        entry.list->push_back(std::move(entry_of_diff));
    }
    made_.diff.sort();
  }

  Database& database_;
  std::pair<std::int64_t, std::int64_t> runs_;
  RunComparison& made_;
  DocumentOfRun before_, after_;
  std::vector<Entry> entries_;
};

}  // namespace

Result<std::unique_ptr<RunComparison>> compare_runs(Database& database,
                                                    const ComparedRuns& request) {
  const Result<std::pair<KeptRun, KeptRun>> runs = runs_to_compare(database, request);
  if (!runs) return runs.error();
  const auto& [before, after] = *runs;
  auto made = std::make_unique<RunComparison>();
  RunComparer comparer(database, before, after, *made);
  if (const Status status = comparer.run(before, after); !status) return status.error();
  return made;
}

}  // namespace strake::project
