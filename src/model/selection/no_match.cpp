// SPDX-License-Identifier: Apache-2.0
// Why a selection picks no object, in words.
#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/text_encoding.hpp"
#include "model/selection/query.hpp"
#include "strake/model/selection.hpp"

namespace strake::model {

namespace {

/// How many objects and groups state an attribute, by its name.
using Statements = std::map<std::string_view, std::size_t>;

Statements statements_of(const Model& model) {
  Statements count;
  const auto add = [&](const Attributes& attributes) {
    for (const auto& [name, value] : attributes) ++count[name];
  };
  for (const Object& object : model.objects) add(object.attributes);
  for (const Attributes& attributes : model.group_attributes) add(attributes);
  return count;
}

void add_attributes(const selection::SelectionQuery& query, std::set<std::string_view>& names) {
  for (const selection::PropertyTest& test : query.tests)
    if (test.field == selection::PropertyField::attribute) names.insert(test.attribute);
  for (const auto& set : query.sets) add_attributes(*set, names);
}

/// The names that most state, first of all; at most a dozen, and how many more there are.
std::string listed(const Statements& count) {
  constexpr std::size_t kMaxListed = 12;
  std::vector<std::pair<std::size_t, std::string_view>> names;
  for (const auto& [name, times] : count) names.emplace_back(times, name);
  std::stable_sort(names.begin(), names.end(),
                   [](const auto& x, const auto& y) { return x.first > y.first; });
  std::string list;
  for (std::size_t i = 0; i < names.size() && i < kMaxListed; ++i) {
    if (i > 0) list += ", ";
    list += '@';
    list += printable(names[i].second);
  }
  if (names.size() > kMaxListed)
    list += " and " + std::to_string(names.size() - kMaxListed) + " more";
  return list;
}

}  // namespace

std::string picks_nothing(const Selection& selection, const Model& model) {
  std::string message = in_quotes(selection.text());
  message += " picks no object";
  std::set<std::string_view> requested;
  add_attributes(*selection.query_, requested);
  if (requested.empty()) return message;
  const Statements stated = statements_of(model);
  const auto unknown = std::find_if(requested.begin(), requested.end(),
                                    [&](std::string_view name) { return !stated.contains(name); });
  if (unknown == requested.end()) return message;
  message += ": no object has an attribute @";
  message += printable(*unknown);
  message += stated.empty() ? std::string(", nor any other") : "; there are " + listed(stated);
  return message;
}

}  // namespace strake::model
