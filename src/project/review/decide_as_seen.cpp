// SPDX-License-Identifier: Apache-2.0
#include "project/review/decide_as_seen.hpp"

#include <optional>
#include <string_view>
#include <utility>

#include "core/text_encoding.hpp"
#include "project/results/clash_rows.hpp"

namespace strake::project {
namespace {

Result<std::int64_t> greatest_id(Database& database, std::string_view table) {
  Result<Statement> select =
      database.prepare("SELECT coalesce(max(id), 0) FROM " + std::string(table));
  if (!select) return select.error();
  const Result<bool> there = select->step();
  if (!there) return there.error();
  return *there ? select->integer(0) : 0;
}

/// Tells what became of clashes after an event.
class LaterEvents {
 public:
  static Result<LaterEvents> of(Database& database, std::int64_t event) {
    Result<Statement> select = database.prepare(
        "SELECT who, before, after, comment, run FROM event WHERE clash = ?1 AND id > ?2 "
        "ORDER BY id DESC LIMIT 1");
    if (!select) return select.error();
    return LaterEvents(std::move(*select), event);
  }

  /// Returns the last of it in a sentence; nothing where nothing happened.
  Result<std::optional<std::string>> last_of(std::int64_t clash) {
    select_.bind(1, clash).bind(2, event_);
    const Result<bool> there = select_.step();
    if (!there) return there.error();
    std::optional<std::string> told;
    if (*there) told = sentence();
    select_.reset();
    return told;
  }

 private:
  LaterEvents(Statement select, std::int64_t event) : select_(std::move(select)), event_(event) {}

  /// What the event says at which the statement stands.
  [[nodiscard]] std::string sentence() const {
    const std::string who(select_.text(0)), after(select_.text(2)), comment(select_.text(3));
    const std::string says = comment.empty() ? std::string() : ": " + comment;
    if (!select_.is_null(4)) return "a later run made it " + after + says;
    if (select_.text(1) != after) return who + " made it " + after + " meanwhile" + says;
    return who + " wrote about it meanwhile" + says;
  }

  Statement select_;
  std::int64_t event_;
};

}  // namespace

Result<SeenState> state_now(Database& database) {
  const Result<std::int64_t> run = greatest_id(database, "run");
  if (!run) return run.error();
  const Result<std::int64_t> event = greatest_id(database, "event");
  if (!event) return event.error();
  return SeenState{*run, *event};
}

Result<DecisionsAsSeen> decide_as_seen(Database& database, std::span<const std::string> keys,
                                       const ClashDecision& decision, const SeenState& seen) {
  Result<ClashRows> rows = ClashRows::of(database);
  if (!rows) return rows.error();
  Result<LaterEvents> events = LaterEvents::of(database, seen.event);
  if (!events) return events.error();
  DecisionsAsSeen outcome;
  std::vector<std::string> standing;
  for (const std::string& key : keys) {
    const Result<std::optional<ClashRow>> row = rows->find(std::string_view(key));
    if (!row) return row.error();
    if (!*row) {
      outcome.refused.push_back({key, "no clash has the key " + in_quotes(key)});
      continue;
    }
    Result<std::optional<std::string>> later = events->last_of((**row).id);
    if (!later) return later.error();
    if (!*later && (**row).gone_run && *(**row).gone_run > seen.run)
      *later = "run " + std::to_string(*(**row).gone_run) + " does not find it any more";
    if (*later) {
      outcome.refused.push_back({key, std::move(**later)});
      continue;
    }
    standing.push_back(key);
    outcome.decided.push_back((**row).id);
  }
  const Result<std::uint64_t> changed = decide(database, standing, decision);
  if (!changed) return changed.error();
  outcome.changed = *changed;
  return outcome;
}

Result<std::vector<std::int64_t>> changed_since(Database& database, std::int64_t event,
                                                std::size_t most) {
  Result<Statement> select =
      database.prepare("SELECT DISTINCT clash FROM event WHERE id > ?1 ORDER BY clash LIMIT ?2");
  if (!select) return select.error();
  select->bind(1, event);
  select->bind(2, static_cast<std::int64_t>(most));
  std::vector<std::int64_t> clashes;
  for (;;) {
    const Result<bool> there = select->step();
    if (!there) return there.error();
    if (!*there) return clashes;
    clashes.push_back(select->integer(0));
  }
}

}  // namespace strake::project
