// SPDX-License-Identifier: Apache-2.0
#include "report/text.hpp"

#include <array>
#include <cmath>
#include <vector>

#include "strake/core/number.hpp"

namespace strake::report {
namespace {

constexpr double kPerMm = 1e6;
constexpr std::string_view kHex = "0123456789abcdef";

void append_escape(std::string& out, unsigned char c) {
  switch (c) {
    case '"':
      out += "\\\"";
      return;
    case '\\':
      out += "\\\\";
      return;
    case '\n':
      out += "\\n";
      return;
    case '\r':
      out += "\\r";
      return;
    case '\t':
      out += "\\t";
      return;
    default:
      out += "\\u00";
      out += kHex[c >> 4U];
      out += kHex[c & 15U];
  }
}

bool continues(std::string_view text, std::size_t at) {
  return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U;
}

}  // namespace

void append_range(std::string& out, const clash::Pair& pair, std::string_view between) {
  append_mm_down(out, pair.d_lower_mm);
  out += between;
  append_mm_up(out, pair.d_upper_mm);
}

void append_point(std::string& out, const clash::Pair& pair, std::string_view between) {
  for (int k = 0; k < 3; ++k) {
    if (k > 0) out += between;
    append_mm(out, pair.point_mm[k]);
  }
}

void append_flags(std::string& out, const clash::Pair& pair, std::string_view between,
                  std::string_view quote) {
  bool first = true;
  for (const std::string_view flag : clash::flag_names(pair.flags)) {
    if (!first) out += between;
    first = false;
    out += quote;
    out += flag;
    out += quote;
  }
}

std::size_t utf8_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char c = byte(at);
  if (c < 0x80) return 1;
  if (c < 0xC2 || c > 0xF4 || !continues(text, at + 1)) return 0;
  if (c < 0xE0) return 2;
  const unsigned char d = byte(at + 1);
  if (!continues(text, at + 2)) return 0;
  if (c < 0xF0) {
    const bool overlong = c == 0xE0 && d < 0xA0, surrogate = c == 0xED && d >= 0xA0;
    return overlong || surrogate ? 0 : 3;
  }
  if (!continues(text, at + 3)) return 0;
  return (c == 0xF0 && d < 0x90) || (c == 0xF4 && d >= 0x90) ? 0 : 4;
}

void append_json(std::string& out, std::string_view text) {
  out += '"';
  for (std::size_t i = 0; i < text.size();) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (c < 0x20 || c == '"' || c == '\\' || c == 0x7F) {
      append_escape(out, c);
      ++i;
    } else if (const std::size_t n = utf8_length(text, i); n > 0) {
      out += text.substr(i, n);
      i += n;
    } else {
      out += "\xEF\xBF\xBD";
      ++i;
    }
  }
  out += '"';
}

void append_mm(std::string& out, double mm) {
  const std::size_t start = out.size();
  append_fixed(out, mm, 6);
  while (out.back() == '0') out.pop_back();
  if (out.back() == '.') out.pop_back();
  if (out.compare(start, std::string::npos, "-0") == 0) out.replace(start, 2, "0");
}

void append_mm_down(std::string& out, double mm) {
  append_mm(out, std::floor(mm * kPerMm) / kPerMm);
}

void append_mm_up(std::string& out, double mm) { append_mm(out, std::ceil(mm * kPerMm) / kPerMm); }

std::string fitted(std::string_view text, std::size_t columns) {
  std::vector<std::string_view> characters;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t n = utf8_length(text, i);
    const auto c = static_cast<unsigned char>(text[i]);
    characters.push_back(n == 0 || c < 0x20 || c == 0x7F ? std::string_view("?")
                                                         : text.substr(i, n));
    i += n == 0 ? 1 : n;
  }
  std::string out;
  if (characters.size() <= columns) {
    for (const std::string_view c : characters) out += c;
    out.append(columns - characters.size(), ' ');
    return out;
  }
  if (columns == 0) return out;
  // The tail of a name tells more than its head, so it gets the larger half.
  const std::size_t head = (columns - 1) / 2, tail = columns - 1 - head;
  for (std::size_t i = 0; i < head; ++i) out += characters[i];
  out += "…";
  for (std::size_t i = characters.size() - tail; i < characters.size(); ++i) out += characters[i];
  return out;
}

}  // namespace strake::report
