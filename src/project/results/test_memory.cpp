// SPDX-License-Identifier: Apache-2.0
#include "project/results/test_memory.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "clash/results/clash_key.hpp"
#include "core/text_encoding.hpp"
#include "project/results/positional_rows.hpp"
#include "report/decisions/decision_match.hpp"

namespace strake::project {
namespace {

using clash::Pair;
using report::DecisionStatus;

constexpr const char* kOnlyPosition = "the id of one of the two is only a position in its file";

Measure measure_of(const Pair& pair) { return {pair.cls, pair.d_mm, pair.regions}; }

ClashSide side_of(const model::Model& model, model::ObjectId id) {
  const model::Object& object = model.object(id);
  return {valid_utf8(model.files[object.file].label), valid_utf8(object.id),
          valid_utf8(object.name)};
}

/// Returns the object of a label and an id, as rows show them. Objects are ordered by both.
std::optional<model::ObjectId> find_object(const model::Model& model, const ClashSide& side) {
  const auto name = [&](const model::Object& o) {
    return std::pair<std::string_view, std::string_view>(model.files[o.file].label, o.id);
  };
  const std::pair<std::string_view, std::string_view> wanted(side.file, side.id);
  auto at = std::ranges::lower_bound(model.objects, wanted, {}, name);
  if (at == model.objects.end() || name(*at) != wanted) {
    // Bytes that are no UTF-8 are shown as another character.
    if (side.file.find(kReplacement) == std::string::npos &&
        side.id.find(kReplacement) == std::string::npos)
      return std::nullopt;
    at = std::ranges::find_if(model.objects, [&](const model::Object& o) {
      return valid_utf8(model.files[o.file].label) == side.file && valid_utf8(o.id) == side.id;
    });
    if (at == model.objects.end()) return std::nullopt;
  }
  return model::ObjectId{static_cast<std::uint32_t>(at - model.objects.begin())};
}

LifeState state_of(const ClashRow& row) {
  return {row.decision, row.decided.value_or(Measure{}), row.decided.has_value()};
}

/// Whether a row was still there, as far as the runs before could tell.
bool was_there(const ClashRow& row) { return !row.gone_run; }

}  // namespace

TestMemory::TestMemory(Database& database, ClashRows& rows, const model::Model& model,
                       const RunFacts& facts, std::int64_t run, const TestedTest& test, TestRow row,
                       const StoredTest* before)
    : database_(database),
      table_(rows),
      model_(model),
      facts_(facts),
      run_(run),
      test_(test),
      report_(*test.report),
      row_(row),
      before_(before),
      is_unchanged_(before != nullptr && before == test.before &&
                    test.work.how == Retested::nothing),
      coverage_(model, *test.sets, *test.policy, *test.report) {}

Status TestMemory::run(const parallel::Context& context) {
  if (is_unchanged_) {
    match_.rows = before_->results.rows;
    match_.before_of.resize(model_.objects.size());
    std::iota(match_.before_of.begin(), match_.before_of.end(), 0U);
  } else if (before_ != nullptr) {
    Result<ReportMatch> match = match_reports(*before_, *test_.snapshot, report_, context);
    if (!match) return match.error();
    match_ = std::move(*match);
  } else {
    match_.rows.assign(report_.pairs.size(), 0);
    for (std::size_t i = 0; i < report_.pairs.size(); ++i)
      match_.different.push_back({std::nullopt, i});
  }
  if (const Status status = take_match(); !status) return status;
  if (const Status status = take_watched(); !status) return status;
  return take_positional();
}

bool TestMemory::is_positional(const Pair& pair) const {
  return report::is_positional(model_, pair);
}

std::string TestMemory::key_of(const Pair& pair) const {
  return clash::pair_key(report_.name, model_, pair.a, pair.b);
}

Result<ClashRow> TestMemory::existing(std::int64_t id) {
  Result<std::optional<ClashRow>> row = table_.find(id);
  if (!row) return row.error();
  if (!*row || (**row).test != row_.id) return database_.damaged("a result has no row of its own");
  return **row;
}

/// What measures something else, came or went since the run before.
Status TestMemory::take_match() {
  for (const PairMatch& match : match_.different) {
    const std::int64_t id = match.now ? match_.rows[*match.now]
                                      : (match.before ? before_->results.rows[*match.before] : 0);
    if (id == 0) {
      if (!match.now) continue;
      if (const Status status = appear(*match.now); !status) return status;
      continue;
    }
    Result<ClashRow> row = existing(id);
    if (!row) return row.error();
    if (!match.now) {
      if (const Status status = miss(std::move(*row)); !status) return status;
      continue;
    }
    const Pair& pair = report_.pairs[*match.now];
    const bool moved = pair.point_mm != before_->results.report.pairs[*match.before].point_mm;
    if (is_positional(pair) && moved) {
      // The number of an object may be another's now: what is where decides.
      match_.rows[*match.now] = 0;
      positional_results_.push_back(*match.now);
      wait(std::move(*row), kOnlyPosition);
    } else if (const Status status = see(std::move(*row), *match.now); !status) {
      return status;
    }
  }
  return {};
}

void TestMemory::wait(ClashRow row, std::string why) {
  handled_.insert(row.id);
  waiting_.push_back({std::move(row), std::move(why)});
}

/// A result that had no row in the run before.
Status TestMemory::appear(std::size_t at) {
  const Pair& pair = report_.pairs[at];
  if (pair.allowed >= 0) return {};
  if (!is_positional(pair) || before_ == nullptr) return add(at);
  positional_results_.push_back(at);
  return {};
}

/// Gives a result the row of its key, or a new one.
Status TestMemory::add(std::size_t at) {
  const Pair& pair = report_.pairs[at];
  const std::string key = key_of(pair);
  Result<std::optional<ClashRow>> known = table_.find(std::string_view(key));
  if (!known) return known.error();
  if (*known && (!is_positional(pair) || (**known).point_mm == pair.point_mm))
    return see(std::move(**known), at);
  if (*known)
    if (const Status status = park(**known); !status) return status;
  ClashRow row;
  row.test = row_.id;
  row.key = key;
  row.first_run = row.new_run = run_;
  describe(row, pair);
  if (const Status status = table_.insert(row); !status) return status;
  ++trend_.written;
  ++trend_.appeared;
  match_.rows[at] = row.id;
  statuses_[at].is_new = true;
  return {};
}

void TestMemory::describe(ClashRow& row, const Pair& pair) const {
  row.a = side_of(model_, pair.a);
  row.b = side_of(model_, pair.b);
  row.now = measure_of(pair);
  row.relation = pair.relation;
  row.point_mm = pair.point_mm;
}

Status TestMemory::see(ClashRow row, std::size_t at) {
  const Pair& pair = report_.pairs[at];
  const ClashRow before = row;
  row.key = key_of(pair);
  describe(row, pair);
  match_.rows[at] = row.id;
  Seen seen{.now = measure_of(pair), .why = {}};
  if (pair.allowed >= 0) {
    seen.sight = Sight::allowed;
    seen.why = report_.allowed[static_cast<std::size_t>(pair.allowed)].rule;
  }
  return apply(before, row, seen, at);
}

SoughtObject TestMemory::sought(const ClashSide& side) const {
  return {side.name.empty() ? side.id : side.name, find_object(model_, side), std::nullopt};
}

/// A row whose result is not there.
Status TestMemory::miss(ClashRow row) {
  const auto before_of = [&](const SoughtObject& object) -> std::optional<model::ObjectId> {
    if (!object.id || before_ == nullptr) return std::nullopt;
    const std::uint32_t o = match_.before_of[index(*object.id)];
    return o == model::kNoObject ? std::nullopt : std::optional(model::ObjectId{o});
  };
  SoughtObject a = sought(row.a), b = sought(row.b);
  a.before = before_of(a);
  b.before = before_of(b);
  const clash::Report* const earlier = is_unchanged_        ? &report_
                                       : before_ == nullptr ? nullptr
                                                            : &before_->results.report;
  std::string why = coverage_.reason(a, b, {row.now, row.unknown, earlier});
  const auto is_place = [&](const SoughtObject& object) {
    return !object.id || model_.object(*object.id).positional_id;
  };
  if (is_place(a) || is_place(b)) {
    wait(std::move(row), why.empty() ? kOnlyPosition : std::move(why));
    return {};
  }
  const Seen seen{why.empty() ? Sight::gone : Sight::cannot_tell, row.now, why};
  const ClashRow before = row;
  return apply(before, row, seen, std::nullopt);
}

/// Writes what this run makes of a row, if that is anything else.
Status TestMemory::apply(const ClashRow& before, ClashRow& row, const Seen& seen,
                         std::optional<std::size_t> pair) {
  handled_.insert(row.id);
  const LifeChange change = next(state_of(before), seen, facts_.deeper_mm);
  row.decision = change.status;
  row.unknown = seen.sight == Sight::cannot_tell ? seen.why : std::string();
  if (!change.is_there) {
    if (was_there(before)) row.gone_run = run_;
  } else if (seen.sight != Sight::cannot_tell) {
    row.gone_run.reset();
  }
  if (change.is_new) row.new_run = run_;
  if (change.is_new) ++trend_.appeared;
  if (!change.cause.empty()) {
    row.decided_by = change.status == DecisionStatus::undecided ? "" : std::string(kProgram);
    row.decided_at = change.status == DecisionStatus::undecided ? "" : facts_.started;
    if (change.status == DecisionStatus::undecided) row.decided.reset();
    if (change.status == DecisionStatus::resolved) ++trend_.gone;
    const ClashEvent event{row.id,
                           run_,
                           facts_.started,
                           std::string(kProgram),
                           before.status(row_.run),
                           row.status(run_),
                           change.cause};
    if (const Status status = table_.add(event); !status) return status;
  }
  if (!row.unknown.empty()) {
    ++trend_.cannot_tell;
    if (row.is_touched()) not_found_.push_back(row);
  }
  if (row != before) {
    if (const Status status = table_.update(row); !status) return status;
    ++trend_.written;
  }
  if (!pair) return {};
  ResultStatus& status = statuses_[*pair];
  status.is_new = row.new_run == run_;
  status.reopened = change.reopened;
  if (row.is_touched() || change.reopened != report::Reopened::no) status.row = row;
  return {};
}

Result<std::vector<ClashRow>> TestMemory::watched() {
  Result<Statement> select = database_.prepare(
      "SELECT " + std::string(kClashColumns) +
      " FROM clash WHERE test = ?1 AND gone_run IS NULL AND (decision IS NOT NULL OR unknown IS "
      "NOT NULL OR comment IS NOT NULL OR assignee IS NOT NULL) ORDER BY id");
  if (!select) return select.error();
  select->bind(1, row_.id);
  std::vector<ClashRow> rows;
  for (;;) {
    const Result<bool> there = select->step();
    if (!there) return there.error();
    if (!*there) return rows;
    Result<ClashRow> row = row_of(database_, *select);
    if (!row) return row.error();
    if (!handled_.contains(row->id)) rows.push_back(std::move(*row));
  }
}

/// Rows that somebody wrote into, or of which the run before could not tell: they are asked about
/// although their results are as they were.
Status TestMemory::take_watched() {
  Result<std::vector<ClashRow>> rows = watched();
  if (!rows) return rows.error();
  if (rows->empty()) return {};
  std::unordered_map<std::int64_t, std::size_t> results;
  for (std::size_t i = 0; i < match_.rows.size(); ++i)
    if (match_.rows[i] != 0) results.emplace(match_.rows[i], i);
  for (ClashRow& row : *rows) {
    const auto at = results.find(row.id);
    const Status status =
        at == results.end() ? miss(std::move(row)) : see(std::move(row), at->second);
    if (!status) return status;
  }
  return {};
}

/// Gives up the key of a row for another clash that has it today.
Status TestMemory::park(ClashRow& row) {
  if (row.key.find('~') == std::string::npos) row.key += "~" + std::to_string(row.id);
  return table_.update(row);
}

/// Results and rows of objects whose ids are only positions: those at one place belong together.
Status TestMemory::take_positional() {
  std::vector<ClashRow> rows;
  for (const WaitingRow& waiting : waiting_) rows.push_back(waiting.row);
  const std::vector<std::optional<std::size_t>> found =
      match_positional(model_, report_, positional_results_, rows);
  std::set<std::string> wanted;
  for (const std::size_t at : positional_results_) wanted.insert(key_of(report_.pairs[at]));
  // A key is given up before it is another's.
  for (ClashRow& row : rows)
    if (wanted.contains(row.key))
      if (const Status status = park(row); !status) return status;
  std::vector<bool> is_found(rows.size());
  for (std::size_t i = 0; i < positional_results_.size(); ++i) {
    const std::size_t at = positional_results_[i];
    if (found[i]) is_found[*found[i]] = true;
    const Status status = found[i] ? see(rows[*found[i]], at) : add(at);
    if (!status) return status;
  }
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (is_found[r]) continue;
    const Seen seen{Sight::cannot_tell, rows[r].now, waiting_[r].why};
    const ClashRow before = rows[r];
    if (const Status status = apply(before, rows[r], seen, std::nullopt); !status) return status;
  }
  return {};
}

}  // namespace strake::project
