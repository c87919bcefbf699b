// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "strake/clash/clash.hpp"
#include "strake/report/decisions.hpp"

/// What statuses, classes and relations are called in topics.
namespace strake::bcf {

inline constexpr std::string_view kTopicType = "Clash";

/// Returns "New", "Active", "Reviewed", "Approved" or "Resolved".
[[nodiscard]] std::string_view topic_status(report::DecisionStatus status);

/// What the status of a topic says of a clash.
enum class ParsedStatus : std::uint8_t { open, active, reviewed, approved, resolved };

/// Returns what the status of a topic says, in the words of Strake or of other programs ("Open",
/// "In Progress", "Closed" …), whatever their case; nothing for any other word. `open` is what New
/// and Active have in common.
[[nodiscard]] std::optional<ParsedStatus> parse_topic_status(std::string_view word);

/// Returns the status that a topic gives to a clash which is in another one.
[[nodiscard]] report::DecisionStatus decided_status(ParsedStatus status);

/// Returns "High" for a hit, "Normal" for a clearance violation, "Low" for a contact.
[[nodiscard]] std::string_view priority(clash::Class cls);

/// Returns how two bodies lie, as a clause of which the first is the subject.
[[nodiscard]] std::string_view relation_clause(clash::Relation relation);

}  // namespace strake::bcf
