// SPDX-License-Identifier: Apache-2.0
#include "bcf/topics/words.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "core/text_encoding.hpp"

namespace strake::bcf {
namespace {

using report::DecisionStatus;

struct Word {
  std::string_view text;
  SaidStatus said;
};

/// In small letters; words of ours, then those that other programs have for the same.
constexpr std::array kWords{
    Word{"new", SaidStatus::open},           Word{"active", SaidStatus::active},
    Word{"reviewed", SaidStatus::reviewed},  Word{"approved", SaidStatus::approved},
    Word{"resolved", SaidStatus::resolved},  Word{"open", SaidStatus::open},
    Word{"opened", SaidStatus::open},        Word{"reopened", SaidStatus::active},
    Word{"re-opened", SaidStatus::active},   Word{"assigned", SaidStatus::active},
    Word{"in progress", SaidStatus::active}, Word{"in_progress", SaidStatus::active},
    Word{"inprogress", SaidStatus::active},  Word{"in review", SaidStatus::reviewed},
    Word{"accepted", SaidStatus::approved},  Word{"ignored", SaidStatus::approved},
    Word{"closed", SaidStatus::resolved},    Word{"done", SaidStatus::resolved},
    Word{"fixed", SaidStatus::resolved},
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

std::optional<SaidStatus> said_status(std::string_view word) {
  const std::string small = lowered(trimmed(word, " \t\r\n"));
  const auto* const at = std::ranges::find(kWords, small, &Word::text);
  return at == kWords.end() ? std::nullopt : std::optional(at->said);
}

DecisionStatus decided_status(SaidStatus said) {
  switch (said) {
    case SaidStatus::open:
    case SaidStatus::active:
      return DecisionStatus::active;
    case SaidStatus::reviewed:
      return DecisionStatus::reviewed;
    case SaidStatus::approved:
      return DecisionStatus::approved;
    case SaidStatus::resolved:
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
