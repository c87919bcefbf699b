// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/json/json.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/text_encoding.hpp"
#include "io/source/text_number.hpp"

namespace strake::io::gltf {

JsonValue JsonDocument::root() const { return {this, settled(0), first_of_piece(pieces_.size())}; }

bool JsonDocument::adopt(std::vector<std::vector<JsonEntry>> pieces) {
  constexpr unsigned kNumberBits = 32;
  std::size_t largest = 0;
  for (const std::vector<JsonEntry>& piece : pieces) largest = std::max(largest, piece.size());
  const auto shift = static_cast<unsigned>(std::bit_width(largest));
  if (shift + static_cast<unsigned>(std::bit_width(pieces.size())) > kNumberBits) return false;
  pieces_ = std::move(pieces);
  shift_ = shift;
  return true;
}

JsonValue JsonValue::operator[](std::string_view key) const { return pick<1>({key}).front(); }

std::vector<JsonValue> JsonValue::items() const {
  std::vector<JsonValue> items;
  if (is_array())
    elements([&](const JsonValue& item) { items.push_back(item); });
  else if (is_object())
    for (JsonValue key = first_child(); key.exists(); key = items.back().after())
      items.push_back(key.after());
  return items;
}

std::optional<double> JsonValue::number() const {
  if (type() != JsonType::number) return std::nullopt;
  const std::string_view text = raw();
  if (text.size() == 1) return text.front() - '0';  // most entries of most matrices
  const char* at = text.data();
  double value = 0;
  DigitStatistics unused;
  if (!read_number(at, at + text.size(), value, unused)) return std::nullopt;
  return value;
}

std::optional<std::uint64_t> JsonValue::index() const {
  constexpr double kMax = 9007199254740992.0;  // 2^53
  const std::optional<double> value = number();
  if (!value || !(*value >= 0 && *value <= kMax) || *value != std::floor(*value))
    return std::nullopt;
  return static_cast<std::uint64_t>(*value);
}

std::optional<bool> JsonValue::boolean() const {
  if (type() != JsonType::boolean) return std::nullopt;
  return raw() == "true";
}

bool JsonValue::numbers(double* out, std::size_t count) const {
  std::size_t found = 0;
  bool good = is_array();
  elements([&](const JsonValue& item) {
    const std::optional<double> value = item.number();
    if (value && found < count) out[found] = *value;
    good = good && value.has_value();
    ++found;
  });
  return good && found == count;
}

namespace {

/// Returns how many bytes at the beginning are ASCII that stands for itself.
std::size_t plain_length(std::string_view text) {
  constexpr std::uint64_t kOnes = 0x0101010101010101U, kHighs = 0x80 * kOnes;
  std::size_t at = 0;
  for (; at + 8 <= text.size(); at += 8) {
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, text.data() + at, 8);
    // A byte becomes zero where a backslash stands; below the first such, no borrow reaches.
    const std::uint64_t backslashes = bytes ^ (kOnes * static_cast<unsigned char>('\\'));
    if (((bytes | ((backslashes - kOnes) & ~backslashes)) & kHighs) != 0) break;
  }
  while (at < text.size() && static_cast<signed char>(text[at]) >= 0 && text[at] != '\\') ++at;
  return at;
}

unsigned hex_value(std::string_view digits) {
  unsigned value = 0;
  for (const char c : digits.substr(0, 4))
    value = 16 * value + static_cast<unsigned>(c <= '9' ? c - '0' : (c | 0x20) - 'a' + 10);
  return value;
}

/// Decodes the \u at the start of the text; a surrogate pair takes two. Returns the length taken.
std::size_t decode_unicode(std::string_view text, std::string& out) {
  const unsigned code = hex_value(text.substr(2));
  const bool high = code >= 0xD800 && code < 0xDC00;
  if (high && text.size() >= 12 && text[6] == '\\' && text[7] == 'u') {
    const unsigned low = hex_value(text.substr(8));
    if (low >= 0xDC00 && low < 0xE000) {
      append_utf8(out, 0x10000 + ((code - 0xD800) << 10U) + (low - 0xDC00));
      return 12;
    }
  }
  append_utf8(out, code >= 0xD800 && code < 0xE000 ? 0xFFFD : code);
  return 6;
}

}  // namespace

std::string JsonValue::text_value() const {
  std::string out;
  append_text(out);
  return out;
}

void JsonValue::append_text(std::string& out) const {
  if (!is_string()) return;
  std::string_view text = raw();
  out.reserve(out.size() + text.size());
  while (true) {
    const std::size_t plain = plain_length(text);
    out.append(text.substr(0, plain));
    text.remove_prefix(plain);
    if (text.empty()) return;
    std::size_t length = first_character(text).length;
    if (length == 0) {
      append_utf8(out, 0xFFFD);
      length = 1;
    } else if (text.front() != '\\') {
      out.append(text.substr(0, length));
    } else if (text[1] == 'u') {
      length = decode_unicode(text, out);
    } else {
      constexpr std::string_view kNames = "bfnrt", kValues = "\b\f\n\r\t";
      const std::size_t known = kNames.find(text[1]);
      out.push_back(known == std::string_view::npos ? text[1] : kValues[known]);
      length = 2;
    }
    text.remove_prefix(length);
  }
}

}  // namespace strake::io::gltf
