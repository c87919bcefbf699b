// SPDX-License-Identifier: Apache-2.0
#include "report/text/table_names.hpp"

#include <algorithm>
#include <map>

#include "core/text_encoding.hpp"
#include "report/text/columns.hpp"
#include "report/text/formatting.hpp"

namespace strake::report {
namespace {

constexpr std::size_t kMinLead = 4;
constexpr std::string_view::size_type kNowhere = std::string_view::npos;

/// Returns where the path of a name begins; kNowhere if it has none.
std::size_t path_begin(std::string_view name) {
  if (name.starts_with('/')) return 0;
  const std::size_t word = name.find(" /");
  if (word != kNowhere) return word + 1;
  return name.find('/') == kNowhere ? kNowhere : 0;
}

/// Returns the beginning that two paths have in common.
std::string_view common_beginning(std::string_view x, std::string_view y) {
  const auto differing = std::ranges::mismatch(x, y);
  return x.substr(0, static_cast<std::size_t>(differing.in1 - x.begin()));
}

}  // namespace

std::string common_lead(std::span<const std::string_view> names) {
  std::string_view first, lead;
  bool differ = false;
  for (const std::string_view name : names) {
    if (name.find(kLeadMark) != kNowhere) return {};
    const std::size_t begin = path_begin(name);
    if (begin == kNowhere) continue;
    const std::string_view path = name.substr(begin);
    if (first.empty()) first = lead = path;
    differ = differ || path != first;
    lead = common_beginning(lead, path);
  }
  const std::size_t end = lead.rfind('/');
  if (!differ || end == kNowhere || end < kMinLead) return {};
  return std::string(lead.substr(0, end));
}

std::string without_lead(std::string_view name, std::string_view lead) {
  const std::size_t begin = lead.empty() ? kNowhere : path_begin(name);
  if (begin == kNowhere) return printable(name);
  std::string rest = printable(name.substr(begin + lead.size()));
  // A group names two, of which the second may have the lead, too.
  const std::string again = " " + printable(lead) + "/";
  for (std::size_t at = rest.find(again); at != kNowhere; at = rest.find(again, at + 1))
    rest.replace(at + 1, again.size() - 2, kLeadMark);
  return printable(name.substr(0, begin)) + std::string(kLeadMark) + rest;
}

std::vector<std::string> shorten_distinctly(const std::vector<std::string>& texts,
                                            std::size_t columns) {
  const auto cut = [&](const std::string& text) {
    return columns_in(text) > columns ? fit_to_columns(text, columns) : text;
  };
  /// The text that looks so; null where there are several.
  std::map<std::string, const std::string*> shown_as;
  for (const std::string& text : texts) {
    const auto [at, is_new] = shown_as.try_emplace(cut(text), &text);
    if (!is_new && at->second != nullptr && *at->second != text) at->second = nullptr;
  }
  std::vector<std::string> out;
  out.reserve(texts.size());
  for (const std::string& text : texts) {
    const std::string shown = cut(text);
    out.push_back(shown_as.at(shown) == nullptr ? text : shown);
  }
  return out;
}

}  // namespace strake::report
