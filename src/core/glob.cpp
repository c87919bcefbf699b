// SPDX-License-Identifier: Apache-2.0
#include "core/glob.hpp"

#include <cstddef>

namespace strake {

namespace {

constexpr std::size_t kNoRange = std::string_view::npos;

/// Returns the length of the UTF-8 sequence at the front; 1 where the bytes are none.
std::size_t character(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : lead >= 0xc0 ? 2 : 1;
  if (length > text.size()) return 1;
  for (std::size_t i = 1; i < length; ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xc0U) != 0x80U) return 1;
  return length;
}

/// Whether `c` is in the set that starts after '[' at pattern[at]; `end` is set past the ']'.
/// An unclosed set leaves `end` at kNoRange.
bool in_set(std::string_view pattern, std::size_t at, char c, std::size_t& end) {
  bool inverted = false;
  if (at < pattern.size() && (pattern[at] == '!' || pattern[at] == '^')) {
    inverted = true;
    ++at;
  }
  const std::size_t close = pattern.find(']', at + 1);  // "[]a]" holds the bracket itself
  end = close == kNoRange ? kNoRange : close + 1;
  if (close == kNoRange) return false;
  bool found = false;
  for (std::size_t i = at; i < close; ++i) {
    if (i + 2 < close && pattern[i + 1] == '-') {
      found = found || (pattern[i] <= c && c <= pattern[i + 2]);
      i += 2;
    } else {
      found = found || pattern[i] == c;
    }
  }
  return found != inverted;
}

/// Matches one pattern element, not '*', at the front of the text: the lengths that both use up,
/// or none.
bool match_one(std::string_view pattern, std::string_view text, std::size_t& used_pattern,
               std::size_t& used_text) {
  used_pattern = 1;
  used_text = 1;
  if (pattern[0] == '?') {
    used_text = character(text);
    return true;
  }
  if (pattern[0] == '[') {
    std::size_t end = kNoRange;
    const bool found = in_set(pattern, 1, text[0], end);
    if (end != kNoRange) {
      used_pattern = end;
      used_text = character(text);
      return found;
    }
  }
  if (pattern[0] == '\\' && pattern.size() > 1) {
    used_pattern = 2;
    return pattern[1] == text[0];
  }
  return pattern[0] == text[0];
}

/// Returns where a star may end at the earliest: at the character that must follow it, where that
/// is a plain one of ASCII, which never occurs within another.
std::size_t next_start(std::string_view after_star, std::string_view text, std::size_t from) {
  const char c = after_star[0];
  const bool plain =
      static_cast<unsigned char>(c) < 0x80U && std::string_view("*?[\\").find(c) == kNoRange;
  return plain ? text.find(c, from) : from;
}

}  // namespace

bool glob_match(std::string_view pattern, std::string_view text) {
  std::size_t p = 0, t = 0;
  // On a mismatch only the last star need be tried again: an earlier one gains nothing that the
  // last one cannot.
  std::size_t star = kNoRange, star_text = 0;
  while (t < text.size()) {
    std::size_t used_pattern = 0, used_text = 0;
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      if (p == pattern.size()) return true;
      t = star_text = next_start(pattern.substr(p), text, t);
      if (t == kNoRange) return false;
    } else if (p < pattern.size() &&
               match_one(pattern.substr(p), text.substr(t), used_pattern, used_text)) {
      p += used_pattern;
      t += used_text;
    } else if (star != kNoRange) {
      p = star + 1;
      star_text += character(text.substr(star_text));
      t = star_text = next_start(pattern.substr(p), text, star_text);
      if (t == kNoRange) return false;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

}  // namespace strake
