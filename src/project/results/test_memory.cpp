// SPDX-License-Identifier: Apache-2.0
#include "project/results/test_memory.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "clash/results/clash_key.hpp"
#include "core/text_encoding.hpp"
#include "project/new_rows/first_rows.hpp"
#include "project/new_rows/shown_side.hpp"
#include "project/results/positional_rows.hpp"
#include "report/decisions/decision_match.hpp"
#include "strake/parallel/transform.hpp"

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

NewClash::Side side_of(const ShownTexts& texts) { return {texts.file, texts.id, texts.name}; }

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

TestMemory::TestMemory(Database& database, ClashRows& rows, ClashHistory& history,
                       const model::Model& model, const RunFacts& facts, std::int64_t run,
                       const TestedTest& test, TestRow row, const StoredTest* before,
                       const clash::PairChanges* changes)
    : database_(database),
      table_(rows),
      history_(history),
      model_(model),
      facts_(facts),
      run_(run),
      test_(test),
      report_(*test.report),
      row_(row),
      before_(before),
      changes_(changes),
      is_unchanged_(before != nullptr && before == test.before &&
                    test.work.how == Retested::nothing),
      coverage_(model, *test.sets, *test.policy, *test.report) {}

Result<ReportMatch> TestMemory::match(const parallel::Context& context) const {
  if (is_unchanged_) return ReportMatch{before_->results.rows, {}};
  if (before_ != nullptr)
    return changes_ == nullptr ? match_reports(*before_, *test_.snapshot, report_, context)
                               : match_changes(*before_, *changes_, report_);
  ReportMatch all;
  all.rows.assign(report_.pairs.size(), 0);
  for (std::size_t i = 0; i < report_.pairs.size(); ++i) all.different.push_back({std::nullopt, i});
  return all;
}

Status TestMemory::run(const parallel::Context& context) {
  Result<ReportMatch> matched = match(context);
  if (!matched) return matched.error();
  match_ = std::move(*matched);
  is_new_.assign(report_.pairs.size(), false);
  if (row_.is_new) {
    const Result<bool> done = take_first(context);
    if (!done) return done.error();
    if (*done) return {};
  }
  if (const Status status = take_match(context); !status) return status;
  if (const Status status = take_watched(); !status) return status;
  return take_positional();
}

std::vector<std::size_t> TestMemory::new_results() const {
  std::vector<std::size_t> results = maybe_new_;
  std::erase_if(results, [&](std::size_t at) { return !is_new_[at]; });
  if (!std::ranges::is_sorted(results)) std::ranges::sort(results);
  const auto repeated = std::ranges::unique(results);
  results.erase(repeated.begin(), repeated.end());
  return results;
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

/// Returns the keys of what is different now and had no row, in its order; zeros for the others.
Result<std::vector<Hash128>> TestMemory::keys_of_new(const parallel::Context& context) const {
  return parallel::transform(
      context, {.name = "keys of clashes", .n = match_.different.size(), .grain = 256},
      [&](std::size_t i) {
        const std::optional<std::size_t> now = match_.different[i].now;
        if (!now || match_.rows[*now] != 0) return Hash128();
        const Pair& pair = report_.pairs[*now];
        return clash::pair_hash(report_.name, model_, pair.a, pair.b);
      });
}

/// The results of a test that was never run, all at once; false: they have to come one by one.
Result<bool> TestMemory::take_first(const parallel::Context& context) {
  const Result<std::vector<Hash128>> keys = keys_of_new(context);
  if (!keys) return keys.error();
  const FirstResults results{row_.id, run_, model_, report_, *keys};
  Result<bool> done = add_first_rows(database_, results, match_.rows);
  if (!done || !*done) return done;
  for (std::size_t at = 0; at < match_.rows.size(); ++at) {
    if (match_.rows[at] == 0) continue;
    is_new_[at] = true;
    maybe_new_.push_back(at);
  }
  trend_.written += maybe_new_.size();
  trend_.appeared += maybe_new_.size();
  return true;
}

/// What measures something else, came or went since the run before.
Status TestMemory::take_match(const parallel::Context& context) {
  const Result<std::vector<Hash128>> keys = keys_of_new(context);
  if (!keys) return keys.error();
  for (std::size_t i = 0; i < match_.different.size(); ++i) {
    const PairMatch& match = match_.different[i];
    const std::int64_t id =
        match.now ? match_.rows[*match.now] : (match.before ? match.before->row : 0);
    if (id == 0) {
      if (!match.now) continue;
      if (const Status status = add_result(*match.now, (*keys)[i]); !status) return status;
      continue;
    }
    Result<ClashRow> row = existing(id);
    if (!row) return row.error();
    if (match.before) keep_open_parts(*row, *match.before->pair);
    if (!match.now) {
      if (const Status status = update_not_found(std::move(*row)); !status) return status;
      continue;
    }
    const Pair& pair = report_.pairs[*match.now];
    const bool moved = pair.point_mm != match.before->pair->point_mm;
    if (is_positional(pair) && moved) {
      // The number of an object may be another's now: what is where decides.
      match_.rows[*match.now] = 0;
      positional_results_.push_back(*match.now);
      wait(std::move(*row), kOnlyPosition);
    } else if (const Status status = update_found(std::move(*row), *match.now); !status) {
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
Status TestMemory::add_result(std::size_t at, const Hash128& key) {
  const Pair& pair = report_.pairs[at];
  if (pair.allowed >= 0) return {};
  if (!is_positional(pair) || before_ == nullptr) return add(at, clash::key_text(key));
  positional_results_.push_back(at);
  return {};
}

/// Gives a result the row of its key, or a new one.
Status TestMemory::add(std::size_t at, const std::string& key) {
  Result<bool> added = insert(at, key);
  if (!added) return added.error();
  if (*added) return {};
  const Pair& pair = report_.pairs[at];
  Result<std::optional<ClashRow>> known = table_.find(std::string_view(key));
  if (!known) return known.error();
  if (*known && (!is_positional(pair) || (**known).point_mm == pair.point_mm))
    return update_found(std::move(**known), at);
  if (*known)
    if (const Status status = park(**known); !status) return status;
  added = insert(at, key);
  if (!added) return added.error();
  return *added ? Status() : database_.damaged("a clash cannot be added");
}

/// Gives a result a new row, unless its key is that of another.
Result<bool> TestMemory::insert(std::size_t at, const std::string& key) {
  const Pair& pair = report_.pairs[at];
  const ShownSide a(model_, pair.a), b(model_, pair.b);
  const Result<std::optional<std::int64_t>> row =
      table_.insert({row_.id, run_, key, side_of(a.texts()), side_of(b.texts()), measure_of(pair),
                     pair.relation, pair.point_mm});
  if (!row) return row.error();
  if (!*row) return false;
  ++trend_.written;
  ++trend_.appeared;
  match_.rows[at] = **row;
  is_new_[at] = true;
  maybe_new_.push_back(at);
  return true;
}

void TestMemory::describe(ClashRow& row, const Pair& pair) const {
  row.a = side_of(model_, pair.a);
  row.b = side_of(model_, pair.b);
  row.now = measure_of(pair);
  row.relation = pair.relation;
  row.point_mm = pair.point_mm;
}

Status TestMemory::update_found(ClashRow row, std::size_t at) {
  const Pair& pair = report_.pairs[at];
  const ClashRow before = row;
  row.key = key_of(pair);
  describe(row, pair);
  match_.rows[at] = row.id;
  Observation observed{.now = measure_of(pair), .why = {}};
  if (pair.allowed >= 0) {
    observed.kind = ObservationKind::allowed;
    observed.why = report_.allowed[static_cast<std::size_t>(pair.allowed)].rule;
  }
  return apply(before, row, observed, at);
}

SoughtObject TestMemory::sought(const ClashSide& side) const {
  return {side.name.empty() ? side.id : side.name, find_object(model_, side), std::nullopt};
}

/// The report of the run before; null: it is not known.
const clash::Report* TestMemory::earlier_report() const {
  if (is_unchanged_) return &report_;
  return before_ == nullptr ? nullptr : &before_->results.report;
}

/// Keeps how open the two objects of a row were in the run before, which had this result of it.
void TestMemory::keep_open_parts(const ClashRow& row, const Pair& before) {
  const std::vector<std::uint8_t>& sheets = before_->results.report.sheets;
  if (sheets.empty()) return;
  const std::uint64_t first = before_->snapshot.identities[index(before.a)];
  OpenParts open{sheets[index(before.a)], sheets[index(before.b)]};
  // The order of the two may have been another one when the row was written.
  if (first == clash::element_hash(row.b.file, row.b.id)) std::swap(open.a, open.b);
  open_before_[row.id] = open;
}

/// What is known of the run that saw a clash last: the one before, or what was kept of an earlier
/// one; nothing where an earlier version of the program kept nothing.
Result<OpenParts> TestMemory::last_open_parts(const ClashRow& row) {
  const Result<std::optional<OpenParts>> kept = history_.unseen(row.id);
  if (!kept) return kept.error();
  if (*kept) return **kept;
  const auto at = open_before_.find(row.id);
  return at == open_before_.end() ? OpenParts{} : at->second;
}

/// A row whose two objects are a contact that the run only counts. It is there, as it would be if
/// the contact were listed; its place and its depth are not known.
Status TestMemory::update_counted(ClashRow row, const clash::UnlistedContact& contact) {
  const ClashRow before = row;
  if (row.now.cls != clash::Class::contact) {
    row.now = {clash::Class::contact, 0, 0};
    row.relation = clash::Relation::abut_outside;
  }
  Observation observed{.now = row.now, .why = {}};
  if (contact.allowed >= 0) {
    observed.kind = ObservationKind::allowed;
    observed.why = report_.allowed[static_cast<std::size_t>(contact.allowed)].rule;
  }
  return apply(before, row, observed, std::nullopt);
}

/// A row whose result is not there.
Status TestMemory::update_not_found(ClashRow row) {
  SoughtObject a = sought(row.a), b = sought(row.b);
  const auto is_place = [&](const SoughtObject& object) {
    return !object.id || model_.object(*object.id).positional_id;
  };
  const bool by_place = is_place(a) || is_place(b);
  if (!by_place)
    if (const clash::UnlistedContact* const contact = coverage_.counted(*a.id, *b.id))
      return update_counted(std::move(row), *contact);
  const Result<OpenParts> open = last_open_parts(row);
  if (!open) return open.error();
  a.open = open->a;
  b.open = open->b;
  std::string why = coverage_.reason(a, b, {row.now, row.unknown, earlier_report()});
  if (by_place) {
    wait(std::move(row), why.empty() ? kOnlyPosition : std::move(why));
    return {};
  }
  const Observation observed{why.empty() ? ObservationKind::gone : ObservationKind::cannot_tell,
                             row.now, why};
  const ClashRow before = row;
  return apply(before, row, observed, std::nullopt);
}

/// Keeps what runs before said of a row, and of one without a result what the run that saw it last
/// knew of its objects.
Status TestMemory::keep_history(const ClashRow& before, const ClashRow& row,
                                const Observation& observed, bool has_result) {
  const auto measures = [](const ClashRow& r) {
    return std::tuple(r.now.cls, r.now.d_mm, r.now.regions, r.gone_run.has_value(), r.unknown);
  };
  if (measures(row) != measures(before))
    if (const Status status = history_.add_former(before, run_); !status) return status;
  if (has_result || row.gone_run) return history_.remove_unseen(row.id);
  Result<OpenParts> open = last_open_parts(before);
  if (!open) return open.error();
  if (observed.kind != ObservationKind::cannot_tell) {
    const SoughtObject a = sought(row.a), b = sought(row.b);
    open = OpenParts{coverage_.open_parts(*a.id), coverage_.open_parts(*b.id)};
  }
  const Result<std::optional<OpenParts>> kept = history_.unseen(row.id);
  if (!kept) return kept.error();
  return *kept == *open ? Status() : history_.set_unseen(row.id, *open);
}

/// Writes what this run makes of a row, if that is anything else.
Status TestMemory::apply(const ClashRow& before, ClashRow& row, const Observation& observed,
                         std::optional<std::size_t> pair) {
  handled_.insert(row.id);
  const LifeChange change = next(state_of(before), observed, facts_.deeper_mm);
  row.decision = change.status;
  row.unknown = observed.kind == ObservationKind::cannot_tell ? observed.why : std::string();
  if (!change.is_there) {
    if (was_there(before)) row.gone_run = run_;
  } else if (observed.kind != ObservationKind::cannot_tell) {
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
  if (const Status status = keep_history(before, row, observed, pair.has_value()); !status)
    return status;
  if (!pair) return {};
  is_new_[*pair] = row.new_run == run_;
  if (is_new_[*pair]) maybe_new_.push_back(*pair);
  if (row.is_touched() || change.reopened != report::Reopened::no)
    reported_.insert_or_assign(*pair, ReportedClash{change.reopened, row});
  return {};
}

Result<std::vector<ClashRow>> TestMemory::watched() {
  Result<Statement> select = database_.prepare(
      "SELECT " + std::string(kClashColumns) +
      " FROM clash WHERE test = ?1 AND gone_run IS NULL AND (decision IS NOT NULL OR unknown IS "
      "NOT NULL OR comment IS NOT NULL OR assignee IS NOT NULL) UNION SELECT " +
      std::string(kClashColumns) +
      " FROM clash WHERE test = ?1 AND id IN (SELECT clash FROM unseen) ORDER BY id");
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

/// Rows that somebody wrote into, or that the run before lists no result of: they are asked about
/// although their results are as they were.
Status TestMemory::take_watched() {
  Result<std::vector<ClashRow>> rows = watched();
  if (!rows) return rows.error();
  if (rows->empty()) return {};
  // Few of very many results have such a row: rows come by their ids.
  std::vector<std::optional<std::size_t>> results(rows->size());
  const std::int64_t first = rows->front().id;
  std::vector<bool> is_watched(static_cast<std::size_t>(rows->back().id - first) + 1, false);
  for (const ClashRow& row : *rows) is_watched[static_cast<std::size_t>(row.id - first)] = true;
  for (std::size_t i = 0; i < match_.rows.size(); ++i) {
    const auto offset = static_cast<std::size_t>(match_.rows[i] - first);
    if (match_.rows[i] < first || offset >= is_watched.size() || !is_watched[offset]) continue;
    const auto at = std::ranges::lower_bound(*rows, match_.rows[i], {}, &ClashRow::id);
    results[static_cast<std::size_t>(at - rows->begin())] = i;
  }
  for (std::size_t r = 0; r < rows->size(); ++r) {
    ClashRow& row = (*rows)[r];
    const Status status =
        results[r] ? update_found(std::move(row), *results[r]) : update_not_found(std::move(row));
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
    const Status status =
        found[i] ? update_found(rows[*found[i]], at) : add(at, key_of(report_.pairs[at]));
    if (!status) return status;
  }
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (is_found[r]) continue;
    const Observation observed{ObservationKind::cannot_tell, rows[r].now, waiting_[r].why};
    const ClashRow before = rows[r];
    if (const Status status = apply(before, rows[r], observed, std::nullopt); !status)
      return status;
  }
  return {};
}

}  // namespace strake::project
