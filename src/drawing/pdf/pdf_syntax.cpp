// SPDX-License-Identifier: Apache-2.0
#include "drawing/pdf/pdf_syntax.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <new>

#include "core/text_encoding.hpp"

namespace strake::drawing {

namespace {

/// Appends units / 10^decimals.
void append_scaled(std::string& out, long long units, int decimals) {
  if (units < 0) out += '-';
  const std::uint64_t size =
      units < 0 ? 0 - static_cast<std::uint64_t>(units) : static_cast<std::uint64_t>(units);
  std::array<char, 24> digits{};
  const char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), size).ptr;
  const std::string_view text(digits.data(), static_cast<std::size_t>(end - digits.data()));
  const auto places = static_cast<std::size_t>(decimals);
  const std::size_t whole = text.size() > places ? text.size() - places : 0;
  std::string_view fraction = text.substr(whole);
  const std::size_t zeros = places - fraction.size();
  while (!fraction.empty() && fraction.back() == '0') fraction.remove_suffix(1);
  out += text.substr(0, whole);
  if (!fraction.empty()) {
    out += '.';
    out.append(zeros, '0');
    out += fraction;
  } else if (whole == 0) {
    out += '0';
  }
}

void append_utf16(std::string& out, std::uint32_t code) {
  const auto unit = [&](std::uint32_t value) {
    out += static_cast<char>(value >> 8U);
    out += static_cast<char>(value & 0xFFU);
  };
  if (code < 0x10000) return unit(code);
  unit(0xD800U + ((code - 0x10000U) >> 10U));
  unit(0xDC00U + ((code - 0x10000U) & 0x3FFU));
}

}  // namespace

void append_pdf_number(std::string& out, double value, int decimals) {
  constexpr std::array<double, 13> kScales{1,   1e1, 1e2, 1e3,  1e4,  1e5, 1e6,
                                           1e7, 1e8, 1e9, 1e10, 1e11, 1e12};
  const double scale = kScales.at(static_cast<std::size_t>(decimals));
  // What is no number, or lies off any paper, is written as a number all the same.
  constexpr double kMax = 9e18;
  const double units = std::isnan(value) ? 0 : std::clamp(value * scale, -kMax, kMax);
  append_scaled(out, std::llround(units), decimals);
}

void append_pdf_point(std::string& out, const PaperPoint& point) {
  for (const double value : {point.x, point.y}) {
    append_pdf_number(out, value, 3);
    out += ' ';
  }
}

void append_pdf_literal(std::string& out, std::string_view bytes) {
  out += '(';
  for (const char c : bytes) {
    if (c == '\r') {  // which would be read as a line feed
      out += "\\r";
      continue;
    }
    if (c == '(' || c == ')' || c == '\\') out += '\\';
    out += c;
  }
  out += ')';
}

std::string pdf_text(std::string_view text) {
  bool plain = true;
  for (const char c : text) plain = plain && c >= ' ' && c <= '~';
  std::string out;
  if (plain) {
    append_pdf_literal(out, text);
    return out;
  }
  constexpr std::uint32_t kUnshown = 0xFFFD;
  std::string wide = "\xFE\xFF";
  while (!text.empty()) {
    const DecodedCharacter c = decode_character(text);
    append_utf16(wide, is_printable(c) ? c.code : kUnshown);
  }
  append_pdf_literal(out, wide);
  return out;
}

std::string pdf_color(const model::Color& color) {
  std::string out;
  for (const std::uint8_t part : {color.red, color.green, color.blue}) {
    append_pdf_number(out, part / 255.0, 3);
    out += ' ';
  }
  return out;
}

std::string pdf_reference(std::uint32_t number) { return std::to_string(number) + " 0 R"; }

std::string deflated(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  // NOLINTBEGIN(cppcoreguidelines-pro-type-reinterpret-cast): zlib's own word for bytes
  const int status = compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()),
                               static_cast<uLong>(bytes.size()), Z_DEFAULT_COMPRESSION);
  // NOLINTEND(cppcoreguidelines-pro-type-reinterpret-cast)
  if (status != Z_OK) throw std::bad_alloc();  // the room is enough for any bytes
  out.resize(size);
  return out;
}

}  // namespace strake::drawing
