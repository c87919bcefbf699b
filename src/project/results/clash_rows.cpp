// SPDX-License-Identifier: Apache-2.0
#include "project/results/clash_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace strake::project {
namespace {

using report::DecisionStatus;

constexpr std::array kClasses{clash::Class::clearance_violation, clash::Class::contact,
                              clash::Class::hit};

/// Finds the value that has a name.
template <class Values>
auto value_of(const Values& values, std::string_view word) {
  const auto at = std::ranges::find_if(values, [&](auto value) { return name(value) == word; });
  return at == std::end(values) ? std::nullopt : std::optional(*at);
}

std::uint32_t count_of(std::int64_t value) {
  return static_cast<std::uint32_t>(
      std::clamp<std::int64_t>(value, 0, std::numeric_limits<std::uint32_t>::max()));
}

ClashSide side_of(const Statement& at, int column) {
  return {std::string(at.text(column)), std::string(at.text(column + 1)),
          std::string(at.text(column + 2))};
}

/// Binds values to the parameters of a statement in their order.
class Binder {
 public:
  explicit Binder(Statement& statement) : statement_(statement) {}

  template <class T>
  Binder& put(T value) {
    statement_.bind(next_++, value);
    return *this;
  }
  Binder& null() {
    statement_.bind_null(next_++);
    return *this;
  }
  Binder& text(std::string_view text) { return put(text); }
  Binder& text_or_null(std::string_view text) { return text.empty() ? null() : put(text); }
  template <class Side>
  Binder& side(const Side& side) {
    return text(side.file).text(side.id).text(side.name);
  }
  Binder& count(std::uint32_t count) { return put(std::int64_t{count}); }

 private:
  Statement& statement_;
  int next_ = 1;
};

/// Binds all columns but the id, in their order.
Binder bind_row(Statement& statement, const ClashRow& row) {
  Binder to(statement);
  to.put(row.test).text(row.key);
  to.side(row.a)
      .side(row.b)
      .text(name(row.now.cls))
      .put(row.now.d_mm)
      .count(row.now.regions)
      .text(name(row.relation));
  to.put(row.point_mm.x).put(row.point_mm.y).put(row.point_mm.z);
  to.put(row.first_run).put(row.new_run);
  row.gone_run ? to.put(*row.gone_run) : to.null();
  to.text_or_null(row.unknown);
  row.decision == DecisionStatus::undecided ? to.null() : to.text(name(row.decision));
  for (const std::string* const text :
       {&row.decided_by, &row.decided_at, &row.comment, &row.assignee})
    to.text_or_null(*text);
  if (!row.decided) return to.null().null().null();
  return to.text(name(row.decided->cls)).put(row.decided->d_mm).count(row.decided->regions);
}

}  // namespace

Result<ClashRow> row_of(const Database& database, const Statement& at) {
  ClashRow row;
  row.id = at.integer(0);
  row.test = at.integer(1);
  row.key = at.text(2);
  row.a = side_of(at, 3);
  row.b = side_of(at, 6);
  const auto cls = value_of(kClasses, at.text(9));
  const auto relation = value_of(clash::kRelations, at.text(12));
  if (!cls || !relation) return database.damaged("a clash is of no class or relation");
  row.now = {*cls, at.real(10), count_of(at.integer(11))};
  row.relation = *relation;
  row.point_mm = {at.real(13), at.real(14), at.real(15)};
  row.first_run = at.integer(16);
  row.new_run = at.integer(17);
  if (!at.is_null(18)) row.gone_run = at.integer(18);
  row.unknown = at.text(19);
  if (!at.is_null(20)) {
    const auto status = value_of(report::kDecisionStatuses, at.text(20));
    if (!status) return database.damaged("a clash has a status that is none");
    row.decision = *status;
  }
  row.decided_by = at.text(21);
  row.decided_at = at.text(22);
  row.comment = at.text(23);
  row.assignee = at.text(24);
  if (at.is_null(25) || at.is_null(26)) return row;
  const auto decided = value_of(kClasses, at.text(25));
  if (!decided) return database.damaged("a clash was decided about as of no class");
  row.decided = Measure{*decided, at.real(26), count_of(at.integer(27))};
  return row;
}

report::DecisionComment ClashEvent::person_comment() const {
  if (run) return {};
  if (!original) return {at, who, comment};
  return {at,
          who,
          original->text,
          original->guid,
          original->topic,
          original->first_at,
          original->first_by};
}

Result<ClashEvent> event_of(const Database& database, const Statement& at) {
  ClashEvent event;
  event.clash = at.integer(0);
  if (!at.is_null(1)) event.run = at.integer(1);
  event.at = at.text(2);
  event.who = at.text(3);
  const auto before = value_of(report::kDecisionStatuses, at.text(4));
  const auto after = value_of(report::kDecisionStatuses, at.text(5));
  if (!before || !after) return database.damaged("an event has a status that is none");
  event.before = *before;
  event.after = *after;
  event.comment = at.text(6);
  if (at.is_null(7)) return event;
  OriginalComment original;
  int column = 7;
  for (std::string* const text :
       {&original.text, &original.guid, &original.topic, &original.first_at, &original.first_by})
    *text = at.text(column++);
  event.original = std::move(original);
  return event;
}

ClashRows::ClashRows(Database& database, Statement by_id, Statement by_key, Statement insert,
                     Statement update, Statement event, Statement original)
    : database_(&database),
      by_id_(std::move(by_id)),
      by_key_(std::move(by_key)),
      insert_(std::move(insert)),
      update_(std::move(update)),
      event_(std::move(event)),
      original_(std::move(original)) {}

Result<ClashRows> ClashRows::of(Database& database) {
  const std::string_view columns = kClashColumns.substr(kClashColumns.find(',') + 1);
  const auto count = static_cast<std::size_t>(std::ranges::count(columns, ',')) + 1;
  std::string places = "?1";
  for (std::size_t p = 2; p <= count; ++p) places += fmt::format(",?{}", p);
  const std::string select = fmt::format("SELECT {} FROM clash WHERE ", kClashColumns);
  Result<Statement> by_id = database.prepare(select + "id = ?1");
  if (!by_id) return by_id.error();
  Result<Statement> by_key = database.prepare(select + "key = ?1");
  if (!by_key) return by_key.error();
  Result<Statement> insert = database.prepare(
      "INSERT INTO clash (test, key, a_file, a_id, a_name, b_file, b_id, b_name, class, d_mm, "
      "regions, relation, x_mm, y_mm, z_mm, first_run, new_run) VALUES "
      "(?1,?2,?3,?4,?5,?6,?7,?8,?9,?10,?11,?12,?13,?14,?15,?16,?16) ON CONFLICT (key) DO NOTHING");
  if (!insert) return insert.error();
  Result<Statement> update = database.prepare(
      fmt::format("UPDATE clash SET ({}) = ({}) WHERE id = ?{}", columns, places, count + 1));
  if (!update) return update.error();
  Result<Statement> event = database.prepare(
      "INSERT INTO event (clash, run, at, who, before, after, comment) "
      "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)");
  if (!event) return event.error();
  Result<Statement> original = database.prepare(
      "INSERT INTO said (event, text, guid, topic, first_at, first_by) "
      "VALUES (?1, ?2, ?3, ?4, ?5, ?6)");
  if (!original) return original.error();
  return ClashRows(database, std::move(*by_id), std::move(*by_key), std::move(*insert),
                   std::move(*update), std::move(*event), std::move(*original));
}

Result<std::optional<ClashRow>> ClashRows::take(Statement& statement) {
  const Result<bool> there = statement.step();
  if (!there) return there.error();
  if (!*there) {
    statement.reset();
    return std::optional<ClashRow>();
  }
  Result<ClashRow> row = row_of(*database_, statement);
  statement.reset();
  if (!row) return row.error();
  return std::optional(std::move(*row));
}

Result<std::optional<ClashRow>> ClashRows::find(std::int64_t id) {
  return take(by_id_.bind(1, id));
}

Result<std::optional<ClashRow>> ClashRows::find(std::string_view key) {
  return take(by_key_.bind(1, key));
}

Result<std::optional<std::int64_t>> ClashRows::insert(const NewClash& row) {
  Binder to(insert_);
  to.put(row.test).text(row.key).side(row.a).side(row.b);
  to.text(name(row.now.cls)).put(row.now.d_mm).count(row.now.regions).text(name(row.relation));
  to.put(row.point_mm.x).put(row.point_mm.y).put(row.point_mm.z).put(row.run);
  if (const Status status = insert_.run(); !status) return status.error();
  if (database_->changes() == 0) return std::optional<std::int64_t>();
  return std::optional(database_->last_insert_id());
}

Status ClashRows::update(const ClashRow& row) {
  bind_row(update_, row).put(row.id);
  return update_.run();
}

Status ClashRows::add(const ClashEvent& event) {
  Binder to(event_);
  to.put(event.clash);
  event.run ? to.put(*event.run) : to.null();
  to.text(event.at).text(event.who).text(name(event.before)).text(name(event.after));
  to.text(event.comment);
  if (const Status status = event_.run(); !status || !event.original) return status;
  const OriginalComment& original = *event.original;
  Binder(original_)
      .put(database_->last_insert_id())
      .text(original.text)
      .text_or_null(original.guid)
      .text_or_null(original.topic)
      .text_or_null(original.first_at)
      .text_or_null(original.first_by);
  return original_.run();
}

}  // namespace strake::project
