// SPDX-License-Identifier: Apache-2.0
#include "pictures/folder/shown_subjects.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "clash/results/clash_key.hpp"
#include "pictures/scenery/clash_place.hpp"
#include "strake/report/decisions.hpp"

namespace strake::pictures {
namespace {

bool only_contacts(const report::WrittenClasses& classes) {
  return classes.contact && !classes.hit && !classes.clearance_violation;
}

std::vector<NamedSubject> results_of(const report::ClashContents& contents) {
  std::vector<NamedSubject> shown;
  const std::vector<clash::Report>& tests = contents.findings.tests;
  for (std::uint32_t t = 0; t < tests.size(); ++t)
    for (std::uint32_t p = 0; p < tests[t].pairs.size(); ++p) {
      const clash::Pair& pair = tests[t].pairs[p];
      if (pair.allowed >= 0) continue;
      if (pair.cls == clash::Class::contact && !only_contacts(contents.classes)) continue;
      if (contents.decided != nullptr && contents.decided->is_settled(t, pair)) continue;
      shown.push_back({subject_of(clash::ResultRef{t, p}),
                       clash::pair_key(tests[t].name, contents.model, pair.a, pair.b),
                       {},
                       0});
    }
  return shown;
}

}  // namespace

std::vector<NamedSubject> shown_subjects(const report::ClashContents& contents) {
  std::vector<NamedSubject> shown;
  if (contents.grouping != nullptr)
    for (const clash::Group& group : contents.grouping->groups)
      shown.push_back({subject_of(contents, group), group.id, group.name, shown.size() + 1});
  else
    shown = results_of(contents);
  const auto rank = [&](const NamedSubject& subject) {
    const clash::Pair& worst = pair_of(contents, subject.subject.results.front());
    return std::tuple(-static_cast<int>(worst.cls), worst.d_mm, std::string_view(subject.key));
  };
  std::ranges::sort(
      shown, [&](const NamedSubject& a, const NamedSubject& b) { return rank(a) < rank(b); });
  for (std::size_t i = 0; i < shown.size(); ++i)
    if (contents.grouping == nullptr) shown[i].number = i + 1;
  return shown;
}

}  // namespace strake::pictures
