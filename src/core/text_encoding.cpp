// SPDX-License-Identifier: Apache-2.0
#include "core/text_encoding.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

namespace strake {

namespace {

void append_escape(std::string& out, char c) {
  constexpr std::string_view kHex = "0123456789abcdef", kNamed = "\"\\\n\r\t", kNames = "\"\\nrt";
  out += '\\';
  if (const std::size_t named = kNamed.find(c); named != std::string_view::npos) {
    out += kNames[named];
    return;
  }
  const auto byte = static_cast<unsigned char>(c);
  out += "u00";
  out += kHex[byte >> 4U];
  out += kHex[byte & 15U];
}

}  // namespace

std::string_view trimmed(std::string_view text, std::string_view blanks) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string lowered(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

std::string in_quotes(std::string_view text) {
  std::string quoted;
  quoted.reserve(text.size() + 2);
  quoted += '\'';
  quoted += text;
  quoted += '\'';
  return quoted;
}

Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return {};
  std::uint32_t code = lead & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {};
    code = code << 6 | (byte(i) & 0x3FU);
  }
  const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  if (overlong || surrogate || code > 0x10FFFF) return {};
  return {code, length};
}

bool is_control(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x2028 || code == 0x2029 ||
         (code & 0xFFFEU) == 0xFFFE || (code >= 0xFDD0 && code < 0xFDF0);
}

bool is_bidi_control(std::uint32_t code) {
  return (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069) ||
         code == 0x200E || code == 0x200F || code == 0x061C;
}

DecodedCharacter decode_character(std::string_view& text) {
  const Character c = first_character(text);
  const std::string_view bytes = text.substr(0, c.length == 0 ? 1 : c.length);
  text.remove_prefix(bytes.size());
  return {c, bytes};
}

bool is_printable(const Character& c) {
  return c.length != 0 && !is_control(c.code) && !is_bidi_control(c.code);
}

std::string printable(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const DecodedCharacter c = decode_character(text);
    out += is_printable(c) ? c.bytes : "?";
  }
  return out;
}

namespace {

/// Whether each of eight bytes stands for itself in a JSON string: printable ASCII, no quote, no
/// backslash.
bool plain_word(std::uint64_t word) {
  constexpr std::uint64_t kOnes = 0x0101010101010101, kHigh = kOnes * 0x80;
  const auto has = [word](std::uint64_t byte) {
    const std::uint64_t x = word ^ (kOnes * byte);
    return ((x - kOnes) & ~x & kHigh) != 0;
  };
  // Without high bits, a byte below the blank borrows one.
  return (word & kHigh) == 0 && ((word - kOnes * 0x20) & kHigh) == 0 && !has('"') && !has('\\') &&
         !has(0x7F);
}

}  // namespace

std::size_t plain_json_prefix(std::string_view text) {
  std::size_t n = 0;
  for (std::uint64_t word = 0; n + sizeof(word) <= text.size(); n += sizeof(word)) {
    std::memcpy(&word, text.data() + n, sizeof(word));
    if (!plain_word(word)) break;
  }
  while (n < text.size() && text[n] >= 0x20 && text[n] < 0x7F && text[n] != '"' && text[n] != '\\')
    ++n;
  return n;
}

bool is_utf8(std::string_view text) {
  for (text.remove_prefix(plain_json_prefix(text)); !text.empty();
       text.remove_prefix(plain_json_prefix(text))) {
    const std::size_t length = first_character(text).length;
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

void append_utf8(std::string& out, std::uint32_t code) {
  const auto put = [&](std::uint32_t byte) { out += static_cast<char>(byte); };
  const auto rest = [&](unsigned shift) { put(0x80U | ((code >> shift) & 0x3FU)); };
  if (code < 0x80) {
    put(code);
    return;
  }
  if (code < 0x800) {
    put(0xC0U | (code >> 6U));
  } else if (code < 0x10000) {
    put(0xE0U | (code >> 12U));
    rest(6);
  } else {
    put(0xF0U | (code >> 18U));
    rest(12);
    rest(6);
  }
  rest(0);
}

namespace {

void move_run(std::string& out, std::string_view& text) {
  const std::size_t n = plain_json_prefix(text);
  out += text.substr(0, n);
  text.remove_prefix(n);
}

}  // namespace

std::string valid_utf8(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (move_run(out, text); !text.empty(); move_run(out, text)) {
    const DecodedCharacter c = decode_character(text);
    out += c.length == 0 ? kReplacement : c.bytes;
  }
  return out;
}

std::string_view valid_utf8(std::string_view text, std::string& room) {
  return is_utf8(text) ? text : std::string_view(room = valid_utf8(text));
}

void append_json_string(std::string& out, std::string_view text) {
  out += '"';
  for (move_run(out, text); !text.empty(); move_run(out, text)) {
    const DecodedCharacter c = decode_character(text);
    if (c.length == 0)
      out += kReplacement;
    else if (c.code < 0x20 || c.code == 0x7F || c.code == '"' || c.code == '\\')
      append_escape(out, c.bytes.front());
    else
      out += c.bytes;
  }
  out += '"';
}

namespace {

constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint8_t kNone = 255;

std::array<std::uint8_t, 256> values_of_digits() {
  std::array<std::uint8_t, 256> values{};
  values.fill(kNone);
  for (std::size_t i = 0; i < kDigits.size(); ++i)
    values[static_cast<std::uint8_t>(kDigits[i])] = static_cast<std::uint8_t>(i);
  return values;
}

}  // namespace

void append_base64(std::string& out, std::span<const std::uint8_t> bytes) {
  out.reserve(out.size() + (bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = (word << 8U) | (k < count ? bytes[i + k] : std::uint8_t{0});
    for (std::size_t k = 0; k < 4; ++k)
      out += k <= count ? kDigits[(word >> (18 - 6 * k)) & 63U] : '=';
  }
}

std::optional<std::vector<std::uint8_t>> parse_base64(std::string_view text) {
  if (text.size() % 4 != 0) return std::nullopt;
  std::size_t padding = 0;
  while (padding < 2 && padding < text.size() && text[text.size() - 1 - padding] == '=') ++padding;
  const auto values = values_of_digits();
  std::vector<std::uint8_t> bytes;
  bytes.reserve(text.size() / 4 * 3);
  const std::size_t digits = text.size() - padding;
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::uint8_t value = i < digits ? values[static_cast<std::uint8_t>(text[i])] : 0;
    if (value == kNone) return std::nullopt;
    word = (word << 6U) | value;
    if (i % 4 != 3) continue;
    for (const unsigned shift : {16U, 8U, 0U})
      bytes.push_back(static_cast<std::uint8_t>((word >> shift) & 255U));
    word = 0;
  }
  // Bits under the padding must be zero, so that every run of bytes has one text.
  for (; padding > 0; --padding) {
    if (bytes.back() != 0) return std::nullopt;
    bytes.pop_back();
  }
  return bytes;
}

}  // namespace strake
