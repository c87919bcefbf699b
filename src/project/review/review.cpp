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

bool agrees(const ReviewStatus& reviewed, DecisionStatus status) {
  return status == reviewed.given || (reviewed.is_open && is_open(status));
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
  const std::string reviewed = rules.compared(topic.assignee), current = rules.compared(now);
  if (reviewed == current) return Ruling::nothing;
  if (topic.written_mark) {
    if (rules.mark(reviewed) == *topic.written_mark) return Ruling::nothing;
    return rules.mark(current) == *topic.written_mark ? Ruling::take : Ruling::conflict;
  }
  if (reviewed.empty()) return Ruling::nothing;
  return current.empty() ? Ruling::take : Ruling::conflict;
}

Error no_listed_clash(const std::string& key) {
  return {ErrorCode::usage, "no clash has the key " + in_quotes(key), {}, {}};
}

/// What people said, in the form in which it is compared: who, what and when.
using CommentKey = std::tuple<std::string, std::string, std::string>;

class ReviewTaker {
 public:
  ReviewTaker(ClashRows rows, ClashEvents events, ClashDecider decider,
              std::vector<ListedClash> clashes, const ReviewRules& rules)
      : rows_(std::move(rows)),
        events_(std::move(events)),
        decider_(std::move(decider)),
        clashes_(std::move(clashes)),
        rules_(rules) {
    std::ranges::sort(clashes_, {}, key_of);
  }

  Status take(const ReviewedTopic& topic) {
    // Comments come first: who sets a status by its side gives the reason with it.
    if (const Status status = take_comments(topic); !status) return status;
    std::vector<std::string> to_status, to_assignee;
    for (const ReviewedClash& clash : topic.clashes) {
      const auto at = listed(clash.key);
      if (at == clashes_.end() || at->row.key != clash.key) return no_listed_clash(clash.key);
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
    const Result<std::uint64_t> changed = decider_.decide(keys, decision);
    if (!changed) return changed.error();
    count += *changed;
    // Its events tell what was decided, which may come back as a comment.
    for (const std::string& key : keys) known_.erase(listed(key)->row.id);
    return {};
  }

  /// Whether what a review says is to be taken; a conflict is reported.
  bool counts(Ruling ruling, const ReviewedTopic& topic, const ListedClash& clash,
              const char* what) {
    if (ruling != Ruling::conflict) return ruling == Ruling::take;
    taken_.conflicts.push_back(
        in_quotes(topic.name) + ", " + clash.row.key + ": " + what +
        " is another one in the project, too; " +
        (rules_.prefers_review ? "that of the review holds now" : "that of the project stays"));
    return rules_.prefers_review;
  }

  [[nodiscard]] CommentKey comment_key(const report::DecisionComment& comment) const {
    return {rules_.compared(comment.by), rules_.compared(comment.text), comment.at};
  }

  /// What is known of what was said of a clash.
  struct KnownComments {
    std::set<CommentKey> keys;
    /// The last words of comments that other programs name, by their GUIDs.
    std::map<std::string, std::string> by_guid;
    std::string last;  ///< when its comment was said

    /// Whether people said this; where it is not known when, whether they said it at any time.
    [[nodiscard]] bool has(const CommentKey& some) const {
      if (!std::get<2>(some).empty()) return keys.contains(some);
      const auto same = keys.lower_bound(some);
      return same != keys.end() && std::get<0>(*same) == std::get<0>(some) &&
             std::get<1>(*same) == std::get<1>(some);
    }
  };

  /// What was said of a clash is read once, however many topics and comments are about it.
  Result<KnownComments*> known_of(const ListedClash& clash) {
    const auto [at, is_new] = known_.try_emplace(clash.row.id);
    KnownComments& known = at->second;
    if (!is_new) return &known;
    const Result<std::vector<ClashEvent>> events = events_.read(clash.row.id);
    if (!events) return events.error();
    for (const ClashEvent& event : *events) {
      if (event.run || event.comment.empty()) continue;
      const report::DecisionComment comment_made = event.person_comment();
      known.keys.insert(comment_key(comment_made));
      // It may have gone out with all that its event tells.
      known.keys.insert(comment_key({event.at, event.who, event.comment}));
      if (!comment_made.guid.empty())
        known.by_guid[comment_made.guid] = rules_.compared(comment_made.text);
      // Behind a comment an event tells what else was set.
      const std::string& comment = clash.row.comment;
      if (!comment.empty() && event.comment.starts_with(comment))
        known.last = std::max(known.last, event.at);
    }
    return &known;
  }

  /// A clash of a topic while its comments are taken.
  struct CommentedClash {
    ListedClash* clash;
    KnownComments* known;
    bool is_changed = false;  ///< a comment of the topic is that of the clash
  };

  Status take_comments(const ReviewedTopic& topic) {
    if (topic.comments.empty()) return {};
    std::vector<CommentedClash> clashes;
    for (const ReviewedClash& clash : topic.clashes) {
      const auto at = listed(clash.key);
      if (at == clashes_.end() || at->row.key != clash.key) return no_listed_clash(clash.key);
      const Result<KnownComments*> known = known_of(*at);
      if (!known) return known.error();
      clashes.push_back({&*at, *known});
    }
    for (const report::DecisionComment& comment : topic.comments)
      if (const Status status = take(comment, topic.at, clashes); !status) return status;
    for (const CommentedClash& clash : clashes)
      if (const Status status = clash.is_changed ? write_comment(*clash.clash) : Status(); !status)
        return status;
    return {};
  }

  /// Takes a comment that none of the clashes has. It is that of a clash where none was said later.
  Status take(report::DecisionComment comment, const std::string& decided_at,
              std::vector<CommentedClash>& clashes) {
    const std::string words = rules_.compared(comment.text);
    const CommentKey key = comment_key(comment);
    for (const CommentedClash& clash : clashes) {
      const auto named = clash.known->by_guid.find(comment.guid);
      const bool is_same = named != clash.known->by_guid.end() && named->second == words;
      if (!is_same && !clash.known->has(key)) continue;
      ++taken_.known_comments;
      return {};
    }
    if (comment.at.empty()) comment.at = decided_at;
    comment.text = valid_utf8(comment.text);
    const CommentKey dated_key = comment_key(comment);
    for (CommentedClash& clash : clashes) {
      KnownComments& known = *clash.known;
      known.keys.insert(dated_key);
      if (!comment.guid.empty()) known.by_guid[comment.guid] = words;
      if (comment.at >= known.last) {
        known.last = comment.at;
        clash.clash->row.comment = comment.text;
        clash.is_changed = true;
      }
      if (const Status status = add(comment, *clash.clash); !status) return status;
    }
    return {};
  }

  /// Adds a comment although it says what was said before: somebody else says it, or again.
  Status add(const report::DecisionComment& comment, const ListedClash& clash) {
    ++taken_.comments;
    ClashEvent event{clash.row.id, std::nullopt, comment.at,  comment.by,
                     clash.status, clash.status, comment.text};
    if (!comment.guid.empty())
      event.original = OriginalComment{comment.text, comment.guid, comment.topic, comment.first_at,
                                       comment.first_by};
    return rows_.add(event);
  }

  /// Writes the comment of a clash; what else its row says may be later than the list.
  Status write_comment(const ListedClash& clash) {
    Result<std::optional<ClashRow>> found = rows_.find(clash.row.id);
    if (!found) return found.error();
    if (!*found) return no_listed_clash(clash.row.key);
    (**found).comment = clash.row.comment;
    return rows_.update(**found);
  }

  ClashRows rows_;
  ClashEvents events_;
  ClashDecider decider_;
  std::vector<ListedClash> clashes_;  ///< by key
  const ReviewRules& rules_;
  std::map<std::int64_t, KnownComments> known_;  ///< by row
  TakenReview taken_;
};

}  // namespace

Result<TakenReview> take_review(Database& database, const std::vector<ReviewedTopic>& topics,
                                const ReviewRules& rules) {
  Result<ClashRows> rows = ClashRows::of(database);
  if (!rows) return rows.error();
  Result<std::vector<ListedClash>> clashes = list_clashes(database, {});
  if (!clashes) return clashes.error();
  Result<ClashEvents> events = ClashEvents::of(database);
  if (!events) return events.error();
  Result<ClashDecider> decider = ClashDecider::of(database);
  if (!decider) return decider.error();
  ReviewTaker taker(std::move(*rows), std::move(*events), std::move(*decider), std::move(*clashes),
                    rules);
  for (const ReviewedTopic& topic : topics)
    if (const Status status = taker.take(topic); !status) return status.error();
  return taker.finish();
}

}  // namespace strake::project
