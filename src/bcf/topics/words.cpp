// SPDX-License-Identifier: Apache-2.0
#include "bcf/topics/words.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "core/text_encoding.hpp"

namespace strake::bcf {
namespace {

using report::DecisionStatus;

struct StatusWord {
  std::string_view text;
  ParsedStatus status;
};

/// In small letters; words of ours, then those that other programs have for the same.
constexpr std::array kWords{
    StatusWord{"new", ParsedStatus::open},
    StatusWord{"active", ParsedStatus::active},
    StatusWord{"reviewed", ParsedStatus::reviewed},
    StatusWord{"approved", ParsedStatus::approved},
    StatusWord{"resolved", ParsedStatus::resolved},
    StatusWord{"open", ParsedStatus::open},
    StatusWord{"opened", ParsedStatus::open},
    StatusWord{"reopened", ParsedStatus::active},
    StatusWord{"re-opened", ParsedStatus::active},
    StatusWord{"assigned", ParsedStatus::active},
    StatusWord{"in progress", ParsedStatus::active},
    StatusWord{"in_progress", ParsedStatus::active},
    StatusWord{"inprogress", ParsedStatus::active},
    StatusWord{"in review", ParsedStatus::reviewed},
    StatusWord{"accepted", ParsedStatus::approved},
    StatusWord{"ignored", ParsedStatus::approved},
    StatusWord{"closed", ParsedStatus::resolved},
    StatusWord{"done", ParsedStatus::resolved},
    StatusWord{"fixed", ParsedStatus::resolved},
};

}  // namespace

std::string_view topic_status(DecisionStatus status) {
  switch (status) {
    case DecisionStatus::undecided:
      return "New";
    case DecisionStatus::active:
      return "Active";
    case DecisionStatus::reviewed:
      return "Reviewed";
    case DecisionStatus::approved:
      return "Approved";
    case DecisionStatus::resolved:
      break;
  }
  return "Resolved";
}

std::optional<ParsedStatus> parse_topic_status(std::string_view word) {
  const std::string small = lowered(trimmed(word, " \t\r\n"));
  const auto* const at = std::ranges::find(kWords, small, &StatusWord::text);
  return at == kWords.end() ? std::nullopt : std::optional(at->status);
}

DecisionStatus decided_status(ParsedStatus status) {
  switch (status) {
    case ParsedStatus::open:
    case ParsedStatus::active:
      return DecisionStatus::active;
    case ParsedStatus::reviewed:
      return DecisionStatus::reviewed;
    case ParsedStatus::approved:
      return DecisionStatus::approved;
    case ParsedStatus::resolved:
      break;
  }
  return DecisionStatus::resolved;
}

std::string_view priority(clash::Class cls) {
  if (cls == clash::Class::hit) return "High";
  return cls == clash::Class::clearance_violation ? "Normal" : "Low";
}

std::string_view relation_clause(clash::Relation relation) {
  switch (relation) {
    case clash::Relation::interfere:
      return "A and B run into each other";
    case clash::Relation::cross:
      return "the surfaces of A and B cross";
    case clash::Relation::a_in_b:
      return "A lies within B";
    case clash::Relation::b_in_a:
      return "B lies within A";
    case clash::Relation::duplicate:
      return "A and B are the same body at the same place";
    case clash::Relation::abut_inside:
      return "A and B touch from within";
    case clash::Relation::abut_outside:
      return "A and B touch";
    case clash::Relation::separate:
      break;
  }
  return "A and B are apart";
}

}  // namespace strake::bcf
