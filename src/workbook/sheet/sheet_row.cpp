// SPDX-License-Identifier: Apache-2.0
#include "workbook/sheet/sheet_row.hpp"

#include <cmath>
#include <optional>

#include "core/number.hpp"
#include "core/text/xml_text.hpp"
#include "core/text_encoding.hpp"

namespace strake::workbook {
namespace {

/// Whether a text begins as what a reader of workbooks takes for a character: "_x0041_".
bool begins_as_escape(std::string_view text) {
  constexpr std::size_t kLength = 7;
  constexpr std::string_view kHex = "0123456789abcdefABCDEF";
  return text.size() >= kLength && text.starts_with("_x") && text[kLength - 1] == '_' &&
         text.substr(2, 4).find_first_not_of(kHex) == std::string_view::npos;
}

}  // namespace

std::string column_name(std::size_t column) {
  constexpr std::size_t kLetters = 26;
  std::string name;
  for (++column; column > 0; column = (column - 1) / kLetters)
    name.insert(name.begin(), static_cast<char>('A' + (column - 1) % kLetters));
  return name;
}

void append_cell_text(std::string& out, std::string_view raw) {
  std::size_t words = 0;
  while (!raw.empty()) {
    if (begins_as_escape(raw)) {
      // Readers take it for a character: the underscore is written as such an escape itself.
      if (words + 1 >= kMaxCellWords) break;
      out += "_x005F_";
      raw.remove_prefix(1);
      ++words;
      continue;
    }
    const std::string_view rest = raw;
    const DecodedCharacter c = decode_character(raw);
    const std::size_t wide = c.length > 0 && c.code > 0xFFFFU ? 2 : 1;
    // The last word is kept for what says that there was more.
    if (words + wide > kMaxCellWords - (raw.empty() ? 0 : 1)) {
      raw = rest;
      break;
    }
    // Line ends of Windows are those of all.
    if (c.code != '\r' || c.length == 0) append_xml(out, c, XmlCharacters::lines);
    words += wide;
  }
  if (!raw.empty()) out += "\xE2\x80\xA6";
}

SheetRow::SheetRow(std::string& out, std::size_t number, int height)
    : out_(out), number_(std::to_string(number + 1)) {
  out_.append("<row r=\"").append(number_).append("\"");
  if (height > 0)
    out_.append(" ht=\"").append(std::to_string(height)).append("\" customHeight=\"1\"");
  out_ += '>';
}

void SheetRow::begin_cell(CellStyle style) {
  out_.append("<c r=\"").append(column_name(column_)).append(number_).append("\"");
  if (style != CellStyle::plain)
    out_.append(" s=\"").append(std::to_string(static_cast<int>(style))).append("\"");
  ++column_;
}

SheetRow& SheetRow::string(std::string_view text, CellStyle style) {
  if (text.empty()) return blank();
  begin_cell(style);
  out_ += " t=\"inlineStr\"><is><t xml:space=\"preserve\">";
  append_cell_text(out_, text);
  out_ += "</t></is></c>";
  return *this;
}

SheetRow& SheetRow::value(std::string_view raw) {
  // What would be another text as a number is a name: 007, +5, 12E3, 1234567890123456789.
  constexpr std::size_t kMaxDigits = 15;
  const std::optional<double> number = parse_number(raw);
  const std::string_view digits = raw.substr(raw.starts_with('-') ? 1 : 0);
  const bool padded = digits.size() > 1 && digits.front() == '0' && digits[1] != '.';
  const bool plain = digits.find_first_not_of("0123456789.") == std::string_view::npos;
  if (!number || padded || !plain || raw.size() > kMaxDigits) return text(raw);
  begin_cell(CellStyle::plain);
  out_.append("><v>").append(shortest(*number)).append("</v></c>");
  return *this;
}

SheetRow& SheetRow::count(std::uint64_t number) {
  begin_cell(CellStyle::whole);
  out_.append("><v>").append(std::to_string(number)).append("</v></c>");
  return *this;
}

SheetRow& SheetRow::number(double value, AppendNumber append) {
  if (!std::isfinite(value)) return blank();
  begin_cell(CellStyle::length);
  out_ += "><v>";
  append(out_, value);
  out_ += "</v></c>";
  return *this;
}

}  // namespace strake::workbook
