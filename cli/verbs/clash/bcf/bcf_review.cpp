// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/clash/bcf/bcf_review.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "bcf/input/read_bcf.hpp"
#include "bcf/topics/words.hpp"
#include "bcf/xml/xml_text.hpp"
#include "cli/run/authorship.hpp"
#include "cli/run/load.hpp"
#include "core/text/counted.hpp"
#include "core/text_encoding.hpp"
#include "project/results/clash_queries.hpp"
#include "project/review/review.hpp"

namespace strake::cli {

namespace {

constexpr std::size_t kMaxTopicsNamed = 10, kLongTopicName = 80;

/// Topics of a file, with what is to be told about them.
struct MatchedTopics {
  std::vector<project::ReviewedTopic> topics;
  std::vector<std::string> unknown;                    ///< topics about no clash of the project
  std::map<std::string, std::uint64_t> strange_words;  ///< statuses that are none, how often
};

std::string name_of(const bcf::ReadTopic& topic) {
  return bcf::short_name(topic.title.empty() ? topic.guid : topic.title, kLongTopicName);
}

/// Finds the clashes that topics are about: by what a topic says of itself, which its GUID bears
/// out, or by the GUID that the key of a clash has.
class TopicMatcher {
 public:
  TopicMatcher(const std::vector<project::ListedClash>& clashes, const BcfReview& review)
      : by_(review.by.empty() ? person() : review.by), at_(utc_time()) {
    for (const project::ListedClash& clash : clashes) keys_.insert(clash.row.key);
  }

  void take(const bcf::ReadTopic& topic) {
    project::ReviewedTopic reviewed;
    reviewed.name = name_of(topic);
    reviewed.clashes = clashes_of(topic);
    if (reviewed.clashes.empty()) {
      matched_.unknown.push_back(reviewed.name);
      return;
    }
    set_status(reviewed, topic);
    reviewed.assignee = bcf::compared_text(topic.assignee);
    if (topic.reference) {
      reviewed.written = topic.reference->status();
      reviewed.written_mark = topic.reference->assignee_mark;
    }
    reviewed.by = topic.changer.empty() ? by_ : bcf::compared_text(topic.changer);
    reviewed.at = topic.changed.empty() ? at_ : topic.changed;
    for (const bcf::ReadComment& comment : topic.comments)
      reviewed.comments.push_back({comment.date, comment.author.empty() ? by_ : comment.author,
                                   comment.text, comment.guid, topic.guid, comment.first_date,
                                   comment.first_author});
    matched_.topics.push_back(std::move(reviewed));
  }

  MatchedTopics finish() { return std::move(matched_); }

 private:
  std::vector<project::ReviewedClash> clashes_of(const bcf::ReadTopic& topic) {
    std::vector<project::ReviewedClash> clashes;
    if (topic.reference) {
      for (const bcf::ReferredClash& clash : topic.reference->clashes)
        if (keys_.contains(clash.key)) clashes.push_back({clash.key, clash.status});
      return clashes;
    }
    if (keys_by_guid_.empty())
      for (const std::string& key : keys_) keys_by_guid_.emplace(bcf::clash_guid(key), key);
    const auto key = keys_by_guid_.find(topic.guid);
    if (key != keys_by_guid_.end()) clashes.push_back({key->second, std::nullopt});
    return clashes;
  }

  void set_status(project::ReviewedTopic& reviewed, const bcf::ReadTopic& topic) {
    if (topic.status.empty()) return;
    const std::optional<bcf::ParsedStatus> parsed = bcf::parse_topic_status(topic.status);
    if (parsed)
      reviewed.status = {bcf::decided_status(*parsed), *parsed == bcf::ParsedStatus::open};
    else
      ++matched_.strange_words[bcf::short_name(topic.status, kLongTopicName)];
  }

  std::string by_, at_;
  std::set<std::string> keys_;
  std::map<std::string, std::string> keys_by_guid_;
  MatchedTopics matched_;
};

/// Prints the first of some texts, and how many more there are.
void list(Console& console, const std::vector<std::string>& texts) {
  const std::size_t shown = std::min(texts.size(), kMaxTopicsNamed);
  for (std::size_t i = 0; i < shown; ++i) console.note("  " + texts[i]);
  if (shown < texts.size()) console.note(fmt::format("  and {} more", texts.size() - shown));
}

void print_review(Console& console, const MatchedTopics& matched, const project::TakenReview& taken,
                  const std::string& file, std::size_t topics) {
  console.note(fmt::format("{}: {}, {} and {} changed, {} added, {} there", file,
                           counted(topics, "topic"), counted(taken.statuses, "status", "statuses"),
                           counted(taken.assignees, "assignee"), counted(taken.comments, "comment"),
                           counted(taken.known_comments, "comment was", "comments were")));
  for (const auto& [word, count] : matched.strange_words)
    console.warn(fmt::format("{}: the status {} of {} means none of a clash: {}", file,
                             in_quotes(word), counted(count, "topic"),
                             count == 1 ? "its own stays" : "theirs stay"));
  if (!taken.conflicts.empty()) {
    console.warn(fmt::format("{}: {}", file, counted(taken.conflicts.size(), "conflict")));
    list(console, taken.conflicts);
  }
  if (!matched.unknown.empty()) {
    console.warn(fmt::format("{}: {} about no clash of the project", file,
                             counted(matched.unknown.size(), "topic is", "topics are")));
    list(console, matched.unknown);
  }
}

}  // namespace

Status take_bcf(Session& session, OpenedProject& opened, const BcfReview& review) {
  const Result<bcf::ReadFile> read = bcf::read_bcf(review.file, session.context());
  if (!read) return read.error();
  project::Database& database = opened.project.database();
  Result<project::Transaction> transaction = project::Transaction::begin(database);
  if (!transaction) return transaction.error();
  const Result<std::vector<project::ListedClash>> clashes = project::list_clashes(database, {});
  if (!clashes) return clashes.error();
  TopicMatcher matcher(*clashes, review);
  for (const bcf::ReadTopic& topic : read->topics) matcher.take(topic);
  const MatchedTopics matched = matcher.finish();
  const Result<project::TakenReview> taken = project::take_review(
      database, matched.topics, {review.prefers_review, bcf::compared_text, bcf::assignee_digest});
  if (!taken) return taken.error();
  if (const Status status = transaction->commit(); !status) return status;
  print_diagnostics(session.console(), read->diagnostics, {"bcf-topic-damaged"});
  print_review(session.console(), matched, *taken, review.file, read->topics.size());
  return {};
}

}  // namespace strake::cli
