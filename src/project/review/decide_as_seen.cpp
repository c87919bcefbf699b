// SPDX-License-Identifier: Apache-2.0
#include "project/review/decide_as_seen.hpp"

#include <fmt/format.h>

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

/// Tells what became of clashes since somebody saw them.
class LaterChanges {
 public:
  static Result<LaterChanges> of(Database& database, const SeenState& seen) {
    // Who is told the status that a later run gave has still not seen what that run found.
    Result<Statement> events = database.prepare(
        "SELECT who, before, after, comment, run FROM event WHERE clash = ?1 AND "
        "(id > ?2 OR run > ?3) ORDER BY id DESC LIMIT 1");
    if (!events) return events.error();
    Result<Statement> former = database.prepare(
        "SELECT run FROM former WHERE clash = ?1 AND run > ?2 ORDER BY run DESC LIMIT 1");
    if (!former) return former.error();
    return LaterChanges(std::move(*events), std::move(*former), seen);
  }

  /// Returns the last of it in a sentence; nothing where nothing happened.
  Result<std::optional<std::string>> last_of(const ClashRow& clash) {
    Result<std::optional<std::string>> told = last_event(clash.id);
    if (!told || *told) return told;
    if (clash.gone_run && *clash.gone_run > seen_.run)
      return std::optional("run " + std::to_string(*clash.gone_run) + " does not find it any more");
    return other_finding(clash);
  }

 private:
  LaterChanges(Statement events, Statement former, const SeenState& seen)
      : events_(std::move(events)), former_(std::move(former)), seen_(seen) {}

  Result<std::optional<std::string>> last_event(std::int64_t clash) {
    events_.bind(1, clash).bind(2, seen_.event).bind(3, seen_.run);
    const Result<bool> there = events_.step();
    if (!there) return there.error();
    std::optional<std::string> told;
    if (*there) told = sentence();
    events_.reset();
    return told;
  }

  /// What the event says at which the statement stands.
  [[nodiscard]] std::string sentence() const {
    const std::string who(events_.text(0)), after(events_.text(2)), comment(events_.text(3));
    const std::string says = comment.empty() ? std::string() : ": " + comment;
    if (!events_.is_null(4)) return "a later run made it " + after + says;
    if (events_.text(1) != after) return who + " made it " + after + " meanwhile" + says;
    return who + " wrote about it meanwhile" + says;
  }

  /// What a later run found that was something else before.
  Result<std::optional<std::string>> other_finding(const ClashRow& clash) {
    former_.bind(1, clash.id).bind(2, seen_.run);
    const Result<bool> there = former_.step();
    if (!there) return there.error();
    std::optional<std::string> told;
    if (*there) {
      const std::string run = "run " + std::to_string(former_.integer(0));
      told = clash.unknown.empty() ? fmt::format("{} finds it otherwise: {}, d = {:.3f} mm", run,
                                                 name(clash.now.cls), clash.now.d_mm)
                                   : run + " cannot tell whether it is there: " + clash.unknown;
    }
    former_.reset();
    return told;
  }

  Statement events_, former_;
  SeenState seen_;
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
  Result<LaterChanges> changes = LaterChanges::of(database, seen);
  if (!changes) return changes.error();
  DecisionsAsSeen outcome;
  std::vector<std::string> standing;
  for (const std::string& key : keys) {
    const Result<std::optional<ClashRow>> row = rows->find(std::string_view(key));
    if (!row) return row.error();
    if (!*row) {
      outcome.refused.push_back({key, "no clash has the key " + in_quotes(key)});
      continue;
    }
    Result<std::optional<std::string>> later = changes->last_of(**row);
    if (!later) return later.error();
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
