// SPDX-License-Identifier: Apache-2.0
#include "page/results/page_facts.hpp"

#include <algorithm>

namespace strake::page {
namespace {

std::uint16_t name_number(NumberedTexts& names, std::string_view name) {
  if (names.all().size() >= kNoName) return kNoName;
  return static_cast<std::uint16_t>(names.number(name));
}

}  // namespace

std::uint32_t NumberedTexts::number(std::string_view text) {
  const auto at = numbers_.find(text);
  if (at != numbers_.end()) return at->second;
  const auto next = static_cast<std::uint32_t>(texts_.size());
  numbers_.emplace(text, next);
  texts_.emplace_back(text);
  return next;
}

PageRows::PageRows(const clash::Findings& findings) : first_{0} {
  for (const clash::Report& test : findings.tests)
    first_.push_back(first_.back() + test.pairs.size());
}

PageRow PageRows::at(std::size_t row) const {
  const auto next = std::upper_bound(first_.begin(), first_.end(), row);
  const auto test = static_cast<std::size_t>(next - first_.begin()) - 1;
  return {test, row - first_[test]};
}

PageNames page_names(const clash::Findings& findings) {
  PageNames names;
  NumberedTexts rules, disciplines;
  for (const clash::Report& test : findings.tests) {
    std::vector<std::uint16_t>& rule_of = names.rule_of.emplace_back();
    for (const clash::AllowedCount& rule : test.allowed)
      rule_of.push_back(name_number(rules, rule.rule));
    std::vector<std::uint16_t>& discipline_of = names.discipline_of.emplace_back();
    for (const clash::DisciplineCount& discipline : test.disciplines)
      discipline_of.push_back(name_number(disciplines, discipline.name));
  }
  names.rules = rules.all();
  names.disciplines = disciplines.all();
  return names;
}

std::uint8_t class_number(clash::Class cls) {
  switch (cls) {
    case clash::Class::hit:
      return 0;
    case clash::Class::contact:
      return 1;
    case clash::Class::clearance_violation:
      return 2;
    case clash::Class::no_hit:
      break;
  }
  return 255;
}

std::uint8_t flag_bits(std::uint16_t flags, bool depth_complete) {
  return static_cast<std::uint8_t>((flags & 15U) | (depth_complete ? 0U : 16U));
}

std::vector<const report::DecidedResult*> decided_rows(const report::ClashContents& contents,
                                                       const PageRows& rows) {
  std::vector<const report::DecidedResult*> decided;
  if (contents.decided == nullptr) return decided;
  decided.reserve(rows.size());
  for (std::size_t t = 0; t < contents.findings.tests.size(); ++t)
    for (const clash::Pair& pair : contents.findings.tests[t].pairs)
      decided.push_back(contents.decided->of(t, pair));
  return decided;
}

}  // namespace strake::page
