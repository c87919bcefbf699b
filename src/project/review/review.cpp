// SPDX-License-Identifier: Apache-2.0
#include "project/review/review.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "core/text_encoding.hpp"
#include "project/results/clash_queries.hpp"
#include "project/results/clash_rows.hpp"

namespace strake::project {
namespace {

using report::DecisionStatus;

/// What became of one thing that a review says.
enum class Ruling : std::uint8_t { nothing, take, conflict };

/// Whether nobody has settled a clash of this status.
bool is_open(DecisionStatus status) { return status <= DecisionStatus::active; }

bool agrees(const ReviewStatus& said, DecisionStatus status) {
  return status == said.given || (said.is_open && is_open(status));
}

Ruling ruling_on_status(const ReviewedTopic& topic, const ReviewedClash& clash,
                        DecisionStatus now) {
  if (!topic.status || agrees(*topic.status, now)) return Ruling::nothing;
  if (topic.written && agrees(*topic.status, *topic.written)) return Ruling::nothing;
  // A clash that nobody decided about becomes Active by the next run, which is no decision either.
  const DecisionStatus before = clash.written.value_or(DecisionStatus::active);
  const bool untouched = now == before || (is_open(now) && is_open(before));
  return untouched ? Ruling::take : Ruling::conflict;
}

Ruling ruling_on_assignee(const ReviewedTopic& topic, const std::string& now,
                          const ReviewRules& rules) {
  const std::string said = rules.compared(topic.assignee), has = rules.compared(now);
  if (said == has) return Ruling::nothing;
  if (topic.written_mark) {
    if (rules.mark(said) == *topic.written_mark) return Ruling::nothing;
    return rules.mark(has) == *topic.written_mark ? Ruling::take : Ruling::conflict;
  }
  if (said.empty()) return Ruling::nothing;
  return has.empty() ? Ruling::take : Ruling::conflict;
}

/// What people said, in the form in which it is compared: who, what and when.
using ComparedSaid = std::tuple<std::string, std::string, std::string>;

class ReviewTaker {
 public:
  ReviewTaker(Database& database, ClashRows rows, std::vector<ListedClash> clashes,
              const ReviewRules& rules)
      : database_(database), rows_(std::move(rows)), clashes_(std::move(clashes)), rules_(rules) {
    std::ranges::sort(clashes_, {}, key_of);
  }

  Status take(const ReviewedTopic& topic) {
    // Comments come first: who sets a status by its side gives the reason with it.
    if (const Status status = take_comments(topic); !status) return status;
    std::vector<std::string> to_status, to_assignee;
    for (const ReviewedClash& clash : topic.clashes) {
      const auto at = listed(clash.key);
      if (at == clashes_.end() || at->row.key != clash.key)
        return Error{ErrorCode::usage, "no clash has the key " + in_quotes(clash.key), {}, {}};
      if (counts(ruling_on_status(topic, clash, at->status), topic, *at, "the status"))
        to_status.push_back(clash.key);
      if (counts(ruling_on_assignee(topic, at->row.assignee, rules_), topic, *at, "the assignee"))
        to_assignee.push_back(clash.key);
    }
    ClashDecision decision{
        .status = {}, .comment = {}, .assignee = {}, .by = topic.by, .at = topic.at};
    if (!to_status.empty()) {
      decision.status = topic.status->given;
      if (const Status status = decide_about(to_status, decision, taken_.statuses); !status)
        return status;
      // Another topic about the clash that says something else is a conflict.
      for (const std::string& key : to_status) listed(key)->status = topic.status->given;
    }
    if (to_assignee.empty()) return {};
    decision.status.reset();
    decision.assignee = topic.assignee;
    if (const Status status = decide_about(to_assignee, decision, taken_.assignees); !status)
      return status;
    for (const std::string& key : to_assignee) listed(key)->row.assignee = topic.assignee;
    return {};
  }

  TakenReview finish() { return std::move(taken_); }

 private:
  static std::string_view key_of(const ListedClash& clash) { return clash.row.key; }

  /// The first clash whose key is not less.
  std::vector<ListedClash>::iterator listed(const std::string& key) {
    return std::ranges::lower_bound(clashes_, std::string_view(key), {}, key_of);
  }

  Status decide_about(const std::vector<std::string>& keys, const ClashDecision& decision,
                      std::uint64_t& count) {
    const Result<std::uint64_t> changed = decide(database_, keys, decision);
    if (!changed) return changed.error();
    count += *changed;
    return {};
  }

  /// Whether what a review says is to be taken; a conflict is told.
  bool counts(Ruling ruling, const ReviewedTopic& topic, const ListedClash& clash,
              const char* what) {
    if (ruling != Ruling::conflict) return ruling == Ruling::take;
    taken_.conflicts.push_back(
        in_quotes(topic.name) + ", " + clash.row.key + ": " + what +
        " is another one in the project, too; " +
        (rules_.prefers_review ? "that of the review holds now" : "that of the project stays"));
    return rules_.prefers_review;
  }

  [[nodiscard]] ComparedSaid said(const report::DecisionComment& comment) const {
    return {rules_.compared(comment.by), rules_.compared(comment.text), comment.at};
  }

  /// Whether people said this; where it is not known when, whether they said it at any time.
  static bool is_known(const std::set<ComparedSaid>& known, const ComparedSaid& said) {
    if (!std::get<2>(said).empty()) return known.contains(said);
    const auto same = known.lower_bound(said);
    return same != known.end() && std::get<0>(*same) == std::get<0>(said) &&
           std::get<1>(*same) == std::get<1>(said);
  }

  /// What is known of what was said of the clashes of a topic.
  struct KnownComments {
    std::set<ComparedSaid> said;
    /// The last words of comments that other programs name, by their GUIDs.
    std::map<std::string, std::string> by_guid;
    std::map<std::string, std::string> last;  ///< when the comment of a clash was said, by key
  };

  Result<KnownComments> known_comments(const ReviewedTopic& topic) {
    KnownComments known;
    for (const ReviewedClash& clash : topic.clashes) {
      const Result<std::vector<ClashEvent>> events = read_events(database_, clash.key);
      if (!events) return events.error();
      const std::string& comment = listed(clash.key)->row.comment;
      for (const ClashEvent& event : *events) {
        if (event.run || event.comment.empty()) continue;
        const report::DecisionComment spoken = event.spoken();
        known.said.insert(said(spoken));
        // It may have gone out with all that its event tells.
        known.said.insert(said({event.at, event.who, event.comment}));
        if (!spoken.guid.empty()) known.by_guid[spoken.guid] = rules_.compared(spoken.text);
        // Behind a comment an event tells what else was set.
        if (!comment.empty() && event.comment.starts_with(comment))
          known.last[clash.key] = std::max(known.last[clash.key], event.at);
      }
    }
    return known;
  }

  Status take_comments(const ReviewedTopic& topic) {
    if (topic.comments.empty()) return {};
    Result<KnownComments> known = known_comments(topic);
    if (!known) return known.error();
    for (report::DecisionComment comment : topic.comments) {
      const auto named = known->by_guid.find(comment.guid);
      const bool is_same =
          named != known->by_guid.end() && named->second == rules_.compared(comment.text);
      if (is_same || is_known(known->said, said(comment))) {
        ++taken_.known_comments;
        continue;
      }
      if (comment.at.empty()) comment.at = topic.at;
      known->said.insert(said(comment));
      if (!comment.guid.empty()) known->by_guid[comment.guid] = rules_.compared(comment.text);
      for (const ReviewedClash& clash : topic.clashes) {
        std::string& latest = known->last[clash.key];
        if (const Status status = add(comment, clash.key, comment.at >= latest); !status)
          return status;
        latest = std::max(latest, comment.at);
      }
    }
    return {};
  }

  /// Adds a comment although it says what was said before: somebody else says it, or again. It is
  /// that of the clash where none was said later.
  Status add(const report::DecisionComment& comment, const std::string& key, bool is_last) {
    Result<std::optional<ClashRow>> found = rows_.find(std::string_view(key));
    if (!found) return found.error();
    if (!*found) return {};
    ClashRow row = std::move(**found);
    const std::string text = valid_utf8(comment.text);
    if (is_last) {
      row.comment = listed(key)->row.comment = text;
      if (const Status status = rows_.update(row); !status) return status;
    }
    const DecisionStatus now = row.status(listed(key)->last_run);
    ++taken_.comments;
    ClashEvent event{row.id, std::nullopt, comment.at, comment.by, now, now, text};
    if (!comment.guid.empty())
      event.said = Said{text, comment.guid, comment.topic, comment.first_at, comment.first_by};
    return rows_.add(event);
  }

  Database& database_;
  ClashRows rows_;
  std::vector<ListedClash> clashes_;  ///< by key
  const ReviewRules& rules_;
  TakenReview taken_;
};

}  // namespace

Result<TakenReview> take_review(Database& database, const std::vector<ReviewedTopic>& topics,
                                const ReviewRules& rules) {
  Result<ClashRows> rows = ClashRows::of(database);
  if (!rows) return rows.error();
  Result<std::vector<ListedClash>> clashes = list_clashes(database, {});
  if (!clashes) return clashes.error();
  ReviewTaker taker(database, std::move(*rows), std::move(*clashes), rules);
  for (const ReviewedTopic& topic : topics)
    if (const Status status = taker.take(topic); !status) return status.error();
  return taker.finish();
}

}  // namespace strake::project
