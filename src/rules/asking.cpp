// SPDX-License-Identifier: Apache-2.0
#include "rules/asking.hpp"

#include <algorithm>
#include <array>

namespace strake::rules {
namespace {

std::string_view bare(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const auto trim = [&] {
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return text = {}, void();
    text = text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
  };
  trim();
  if (text.size() >= 2 && (text.front() == '\'' || text.front() == '"') &&
      text.back() == text.front()) {
    text = text.substr(1, text.size() - 2);
    trim();
  }
  return text;
}

bool says_none(std::string_view value) {
  constexpr std::array<std::string_view, 5> kNone{"", "nulref", "unset", "none", "=0/0"};
  const auto same = [&](std::string_view word) {
    return std::equal(value.begin(), value.end(), word.begin(), word.end(), [](char a, char b) {
      return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
    });
  };
  return std::any_of(kNone.begin(), kNone.end(), same);
}

}  // namespace

std::vector<bool> Asking::pick(const Chooser& chooser) {
  std::vector<bool> picked(objects());
  if (error_) return picked;
  const auto found = model::pick(chooser.selection, scene_, context_);
  if (!found) {
    error_ = found.error();
    return picked;
  }
  bool some = false;
  for (std::size_t o = 0; o < picked.size(); ++o) {
    picked[o] = (*found)[o] != 0;
    some = some || picked[o];
  }
  if (!some) nothing(chooser.where, "'" + chooser.selection.text() + "' picks no object");
  return picked;
}

std::vector<bool> Asking::pick(const std::optional<Chooser>& chooser) {
  return chooser ? pick(*chooser) : std::vector<bool>(objects(), true);
}

void Asking::nothing(const std::string& where, const std::string& what) {
  diagnostics_.add(Severity::warning, "rule-matches-nothing", what, where);
}

std::vector<std::string_view> values_of(const model::Object& object, std::string_view attribute) {
  std::vector<std::string_view> values;
  for (const auto& [name, value] : object.attributes) {
    if (name != attribute) continue;
    const std::string_view text = bare(value);
    if (!says_none(text)) values.push_back(text);
  }
  return values;
}

}  // namespace strake::rules
