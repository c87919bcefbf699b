// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "strake/report/decisions.hpp"

/// What a topic says of itself at the end of its description, so that a file which comes back is
/// understood: which clashes it is about, and what was known of them when it was written. Programs
/// that hand topics on keep descriptions, though few keep anything else (decision 0084).
namespace strake::bcf {

/// A clash of a topic, with its status when the topic was written.
struct ReferredClash {
  std::string key;
  report::DecisionStatus status = report::DecisionStatus::undecided;
};

struct ClashReference {
  std::string group;          ///< clash::Group::id; empty: the topic is about one clash
  std::string assignee_mark;  ///< assignee_digest() of whom the topic was assigned to
  std::vector<ReferredClash> clashes;

  /// Returns the status that the topic was written with: the least of those of its clashes.
  [[nodiscard]] report::DecisionStatus status() const;
};

/// The most clashes that a topic names: it decides about these alone.
inline constexpr std::size_t kMaxReferred = 1000;

/// Returns the GUID of the topic of a clash, by its key, and of a group, by its id: the same in
/// every file.
[[nodiscard]] std::string clash_guid(std::string_view key);
[[nodiscard]] std::string group_guid(std::string_view group_id);
/// Returns the GUID that a topic with this reference has.
[[nodiscard]] std::string guid_of(const ClashReference& reference);
/// Returns the GUID of something of a topic, as of its viewpoint.
[[nodiscard]] std::string part_guid(std::string_view topic_guid, std::string_view part);

/// Whether a text is a GUID as the schemas have it, in small letters.
[[nodiscard]] bool is_guid(std::string_view text);

/// Returns eight digits by which an assignee is known again; "none" for nobody.
[[nodiscard]] std::string assignee_digest(std::string_view assignee);

/// Returns the reference as a line of a description.
[[nodiscard]] std::string reference_line(const ClashReference& reference);

/// Finds the reference in a description, however its blanks and line ends were laid out anew;
/// nothing where there is none, or it is damaged.
[[nodiscard]] std::optional<ClashReference> find_reference(std::string_view description);

}  // namespace strake::bcf
