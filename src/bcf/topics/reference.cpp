// SPDX-License-Identifier: Apache-2.0
#include "bcf/topics/reference.hpp"

#include <algorithm>
#include <set>

#include "clash/results/clash_key.hpp"
#include "report/text/uuid.hpp"

namespace strake::bcf {
namespace {

using report::DecisionStatus;

constexpr std::string_view kBegin = "Strake-reference:";
constexpr std::string_view kGroup = "group=", kAssignee = "assignee=";
constexpr std::string_view kBlanks = " \t\r\n";

/// Takes the next word off a text; empty at its end.
std::string_view read_word(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
  text.remove_prefix(word.size());
  return word;
}

std::optional<DecisionStatus> status_named(std::string_view word) {
  for (const DecisionStatus status : report::kDecisionStatuses)
    if (name(status) == word) return status;
  return std::nullopt;
}

/// Reads "KEY=STATUS"; nothing for any other word.
std::optional<ReferredClash> referred(std::string_view word) {
  const std::size_t equals = word.find('=');
  if (equals == std::string_view::npos) return std::nullopt;
  const std::string_view key = word.substr(0, equals);
  const std::optional<DecisionStatus> status = status_named(word.substr(equals + 1));
  if (!status || !clash::parse_key(key)) return std::nullopt;
  return ReferredClash{std::string(key), *status};
}

}  // namespace

DecisionStatus ClashReference::status() const {
  if (clashes.empty()) return DecisionStatus::undecided;
  return std::ranges::min(clashes, {}, &ReferredClash::status).status;
}

std::string clash_guid(std::string_view key) {
  return report::uuid_from_key(report::kClashNamespace, key);
}

std::string group_guid(std::string_view group_id) {
  return report::uuid_from_key(report::kClashNamespace, "group:" + std::string(group_id));
}

std::string guid_of(const ClashReference& reference) {
  if (!reference.group.empty()) return group_guid(reference.group);
  return reference.clashes.empty() ? std::string() : clash_guid(reference.clashes.front().key);
}

std::string part_guid(std::string_view topic_guid, std::string_view part) {
  return report::uuid_from_key(topic_guid, part);
}

bool is_guid(std::string_view text) {
  constexpr std::string_view kForm = "00000000-0000-0000-0000-000000000000";
  if (text.size() != kForm.size()) return false;
  for (std::size_t i = 0; i < kForm.size(); ++i) {
    const char c = text[i];
    const bool is_digit = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
    if (kForm[i] == '-' ? c != '-' : !is_digit) return false;
  }
  return true;
}

std::string assignee_digest(std::string_view assignee) {
  if (assignee.empty()) return "none";
  constexpr std::size_t kDigits = 8;
  return report::uuid_from_key(report::kClashNamespace, "assignee:" + std::string(assignee))
      .substr(0, kDigits);
}

std::string reference_line(const ClashReference& reference) {
  std::string line(kBegin);
  if (!reference.group.empty()) line.append(" ").append(kGroup).append(reference.group);
  line.append(" ").append(kAssignee).append(reference.assignee_mark);
  for (const ReferredClash& clash : reference.clashes)
    line.append(" ").append(clash.key).append("=").append(name(clash.status));
  return line;
}

std::optional<ClashReference> find_reference(std::string_view description) {
  // Names that stand before it may hold the same words: the last one counts.
  const std::size_t at = description.rfind(kBegin);
  if (at == std::string_view::npos) return std::nullopt;
  std::string_view rest = description.substr(at + kBegin.size());
  ClashReference reference;
  std::string_view word = read_word(rest);
  if (word.starts_with(kGroup)) {
    reference.group = word.substr(kGroup.size());
    word = read_word(rest);
  }
  if (!word.starts_with(kAssignee)) return std::nullopt;
  reference.assignee_mark = word.substr(kAssignee.size());
  // A clash that is named twice is decided about once, as it was named first.
  std::set<std::string> keys;
  while (reference.clashes.size() < kMaxReferred) {
    std::optional<ReferredClash> clash = referred(read_word(rest));
    if (!clash) break;
    if (keys.insert(clash->key).second) reference.clashes.push_back(std::move(*clash));
  }
  if (reference.clashes.empty() || (reference.group.empty() && reference.clashes.size() > 1))
    return std::nullopt;
  return reference;
}

}  // namespace strake::bcf
