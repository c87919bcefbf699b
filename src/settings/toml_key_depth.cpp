// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <string>

#include "settings/toml_document.hpp"

namespace strake::settings {
namespace {

/// Returns the offset behind the closing quotes; a block may end in one or two quotes of its own
/// before those that close it.
std::size_t behind_marks(std::string_view text, std::size_t at, char quote) {
  for (int own = 0; own < 2 && at < text.size() && text[at] == quote; ++own) ++at;
  return at;
}

/// Returns the offset behind the string or the comment that begins at `at`.
std::size_t behind_text(std::string_view text, std::size_t at) {
  const char quote = text[at];
  if (quote == '#') return std::min(text.find('\n', at), text.size());
  const std::string marks(3, quote);
  const bool block = text.substr(at, 3) == marks;  // goes over lines
  for (at += block ? 3 : 1; at < text.size(); ++at) {
    if (text[at] == '\\' && quote == '"')
      ++at;
    else if (block && text.substr(at, 3) == marks)
      return behind_marks(text, at + 3, quote);
    else if (!block && (text[at] == quote || text[at] == '\n'))
      return at + 1;
  }
  return text.size();
}

bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// Whether a character ends every key.
bool ends_key(char c) { return std::string_view("=,[]{}\n").find(c) != std::string_view::npos; }

SourcePosition place_of(std::string_view text, std::size_t at) {
  const std::string_view before = text.substr(0, at);
  const std::size_t line = before.rfind('\n');  // npos + 1 is 0
  return {static_cast<std::uint32_t>(std::ranges::count(before, '\n') + 1),
          static_cast<std::uint32_t>(at - (line + 1) + 1)};
}

}  // namespace

std::optional<SourcePosition> first_deep_key(std::string_view text, std::size_t limit) {
  std::size_t dots = 0, start = 0;  // of the key, or the value, that is being passed
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'' || c == '#') {
      at = behind_text(text, at);
      continue;
    }
    ++at;
    if (ends_key(c)) {
      dots = 0;
      start = at;
    } else if (is_blank(c) && start + 1 == at) {
      start = at;
    } else if (c == '.' && ++dots >= limit) {
      return place_of(text, start);
    }
  }
  return std::nullopt;
}

}  // namespace strake::settings
