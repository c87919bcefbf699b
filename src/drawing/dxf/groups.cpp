// SPDX-License-Identifier: Apache-2.0
#include "drawing/dxf/groups.hpp"

#include <array>
#include <charconv>

#include "core/number.hpp"
#include "core/text_encoding.hpp"

namespace strake::drawing::dxf {

namespace {

void append_whole(std::string& out, std::int64_t value) {
  std::array<char, 24> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  out.append(digits.data(), end);
}

/// Whether readers would take a line separator of Unicode for the end of a line.
bool ends_line(std::uint32_t code) { return code == 0x2028 || code == 0x2029; }

/// Returns how one line of a file spells a character; `rest` follows it.
std::string_view spelling(const DecodedCharacter& c, std::string_view rest) {
  if (!is_printable(c) || ends_line(c.code)) return kReplacement;
  if (c.code == '^') return "^ ";
  if (c.code == '\\' && (rest.starts_with("U+") || rest.starts_with("M+"))) return "\\U+005C";
  return c.bytes;
}

/// Calls `spell` for each character with what precedes and what follows it, and joins what it
/// returns, up to `limit` bytes.
template <class Spell>
std::string spelled(std::string_view text, std::size_t limit, Spell&& spell) {
  constexpr std::string_view kEllipsis = "\xE2\x80\xA6";
  std::string out;
  std::size_t room = 0;  // the length of what leaves room for the ellipsis
  std::uint32_t before = 0;
  while (!text.empty()) {
    const DecodedCharacter c = decode_character(text);
    out += spell(before, c, text);
    before = c.code;
    if (out.size() + kEllipsis.size() <= limit) room = out.size();
    if (out.size() <= limit) continue;
    out.resize(room);
    out += kEllipsis;
    break;
  }
  return out;
}

}  // namespace

void Groups::append_code(int code) {
  append_whole(*out_, code);
  *out_ += '\n';
}

Groups& Groups::text(int code, std::string_view value) {
  append_code(code);
  *out_ += value;
  *out_ += '\n';
  return *this;
}

Groups& Groups::whole(int code, std::int64_t value) {
  append_code(code);
  append_whole(*out_, value);
  *out_ += '\n';
  return *this;
}

Groups& Groups::handle(int code, Handle value) {
  append_code(code);
  std::array<char, 16> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value, 16).ptr;
  for (const char* digit = digits.data(); digit != end; ++digit)
    *out_ += *digit >= 'a' ? static_cast<char>(*digit - 'a' + 'A') : *digit;
  *out_ += '\n';
  return *this;
}

Groups& Groups::number(int code, double value) {
  append_code(code);
  append_shortest(*out_, value);
  *out_ += '\n';
  return *this;
}

Groups& Groups::point(int code, double x, double y) { return number(code, x).number(code + 10, y); }

Groups& Groups::point_in_space(int code, double x, double y) {
  return point(code, x, y).whole(code + 20, 0);
}

std::string value_text(std::string_view text, std::size_t limit) {
  return spelled(text, limit, [](std::uint32_t, const DecodedCharacter& c, std::string_view rest) {
    return spelling(c, rest);
  });
}

std::string shown_text(std::string_view text) {
  // "%%%" is one percent sign; alone it is itself.
  return spelled(text, kMaxOfText,
                 [](std::uint32_t before, const DecodedCharacter& c, std::string_view rest) {
                   const bool doubled = c.code == '%' && (before == '%' || rest.starts_with('%'));
                   return doubled ? std::string_view("%%%") : spelling(c, rest);
                 });
}

}  // namespace strake::drawing::dxf
