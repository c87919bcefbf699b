// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "project/database/database.hpp"
#include "strake/core/result.hpp"
#include "strake/report/decisions.hpp"

/// Decisions that people made in other programs, taken into a project.
namespace strake::project {

/// A status that a topic states: those that it agrees with, and the one that it gives.
struct ReviewStatus {
  report::DecisionStatus given = report::DecisionStatus::active;
  bool is_open = false;  ///< it only says that the clash is not settled: New is as good as Active
};

/// A clash that a topic is about.
struct ReviewedClash {
  std::string key;
  /// Its status when the topic was written; absent: not known.
  std::optional<report::DecisionStatus> written;
};

/// What somebody decided about clashes at once.
struct ReviewedTopic {
  std::string name;  ///< for messages
  std::vector<ReviewedClash> clashes;
  std::optional<ReviewStatus> status;  ///< absent: nothing is said of it
  /// The status that the topic was written with; absent: not known.
  std::optional<report::DecisionStatus> written;
  std::string assignee;  ///< empty: nobody
  /// ReviewRules::mark of whom the topic was assigned to when it was written; absent: not known.
  std::optional<std::string> written_mark;
  std::string by, at;  ///< who decided, and when
  /// In their order; one without a time was said when the topic was decided about.
  std::vector<report::DecisionComment> comments;
};

/// Returns another form of a text.
using TextForm = std::string (*)(std::string_view);

struct ReviewRules {
  /// What counts where a status or an assignee changed in the project and in the review: by default
  /// the project's.
  bool prefers_review = false;
  /// The form in which comments and names are compared, since other programs lay texts out anew.
  TextForm compared = nullptr;
  /// The mark of an assignee, in that form.
  TextForm mark = nullptr;
};

struct TakenReview {
  std::uint64_t statuses = 0, assignees = 0;  ///< clashes of which it changed
  std::uint64_t comments = 0;                 ///< added to a clash
  std::uint64_t known_comments = 0;           ///< that were there already
  std::vector<std::string> conflicts;         ///< each told, with what holds now
};

/// Takes decisions into a project, each with an event.
///
/// 1. A status or assignee that is as it was when the topic was written changes nothing.
/// 2. What changed in the review and not in the project is taken.
/// 3. What changed in both, to something else, is a conflict, as is a decision about which it is
///    not known what the review started from: ReviewRules::prefers_review says which one holds.
/// 4. A comment is known if one of the clashes of its topic has it: of the same GUID and words, or
///    of the same time, author and words; of the same author, where it has no time. One whose GUID
///    is known and whose words are others was edited, and is added with the GUID.
/// 5. Of topics about one clash the first holds: what a later one says against it is a conflict.
///
/// To be called within a transaction. Errors: as of decide(); usage for a key that no clash has.
[[nodiscard]] Result<TakenReview> take_review(Database& database,
                                              const std::vector<ReviewedTopic>& topics,
                                              const ReviewRules& rules);

}  // namespace strake::project
