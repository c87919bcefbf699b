// SPDX-License-Identifier: Apache-2.0
#include "project/review/decide_if_unchanged.hpp"

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
  static Result<LaterChanges> of(Database& database, const KnownState& known) {
    // Who is told the status that a later run gave has still not seen what that run found.
    Result<Statement> events = database.prepare(
        "SELECT who, before, after, comment, run FROM event WHERE clash = ?1 AND "
        "(id > ?2 OR run > ?3) ORDER BY id DESC LIMIT 1");
    if (!events) return events.error();
    Result<Statement> former = database.prepare(
        "SELECT run FROM former WHERE clash = ?1 AND run > ?2 ORDER BY run DESC LIMIT 1");
    if (!former) return former.error();
    return LaterChanges(std::move(*events), std::move(*former), known);
  }

  /// Returns the last of it in a sentence; nothing where nothing happened.
  Result<std::optional<std::string>> last_of(const ClashRow& clash) {
    Result<std::optional<std::string>> change = last_event(clash.id);
    if (!change || *change) return change;
    if (clash.gone_run && *clash.gone_run > known_.run)
      return std::optional("run " + std::to_string(*clash.gone_run) + " does not find it any more");
    return other_finding(clash);
  }

 private:
  LaterChanges(Statement events, Statement former, const KnownState& known)
      : events_(std::move(events)), former_(std::move(former)), known_(known) {}

  Result<std::optional<std::string>> last_event(std::int64_t clash) {
    events_.bind(1, clash).bind(2, known_.event).bind(3, known_.run);
    const Result<bool> there = events_.step();
    if (!there) return there.error();
    std::optional<std::string> change;
    if (*there) change = sentence();
    events_.reset();
    return change;
  }

  /// What the event says at which the statement stands.
  [[nodiscard]] std::string sentence() const {
    const std::string who(events_.text(0)), after(events_.text(2)), comment(events_.text(3));
    const std::string comment_suffix = comment.empty() ? std::string() : ": " + comment;
    if (!events_.is_null(4)) return "a later run made it " + after + comment_suffix;
    if (events_.text(1) != after) return who + " made it " + after + " meanwhile" + comment_suffix;
    return who + " wrote about it meanwhile" + comment_suffix;
  }

  /// What a later run found that was something else before.
  Result<std::optional<std::string>> other_finding(const ClashRow& clash) {
    former_.bind(1, clash.id).bind(2, known_.run);
    const Result<bool> there = former_.step();
    if (!there) return there.error();
    std::optional<std::string> change;
    if (*there) {
      const std::string run = "run " + std::to_string(former_.integer(0));
      change = clash.unknown.empty() ? fmt::format("{} finds it otherwise: {}, d = {:.3f} mm", run,
                                                   name(clash.now.cls), clash.now.d_mm)
                                     : run + " cannot tell whether it is there: " + clash.unknown;
    }
    former_.reset();
    return change;
  }

  Statement events_, former_;
  KnownState known_;
};

}  // namespace

Result<KnownState> current_state(Database& database) {
  const Result<std::int64_t> run = greatest_id(database, "run");
  if (!run) return run.error();
  const Result<std::int64_t> event = greatest_id(database, "event");
  if (!event) return event.error();
  return KnownState{*run, *event};
}

Result<DecideOutcome> decide_if_unchanged(Database& database, std::span<const std::string> keys,
                                          const ClashDecision& decision, const KnownState& known) {
  Result<ClashRows> rows = ClashRows::of(database);
  if (!rows) return rows.error();
  Result<LaterChanges> changes = LaterChanges::of(database, known);
  if (!changes) return changes.error();
  DecideOutcome outcome;
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
                                                std::size_t limit) {
  Result<Statement> select =
      database.prepare("SELECT DISTINCT clash FROM event WHERE id > ?1 ORDER BY clash LIMIT ?2");
  if (!select) return select.error();
  select->bind(1, event);
  select->bind(2, static_cast<std::int64_t>(limit));
  std::vector<std::int64_t> clashes;
  for (;;) {
    const Result<bool> there = select->step();
    if (!there) return there.error();
    if (!*there) return clashes;
    clashes.push_back(select->integer(0));
  }
}

}  // namespace strake::project
