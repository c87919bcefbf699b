// SPDX-License-Identifier: Apache-2.0
#include "report/text/csv.hpp"

#include "core/number.hpp"
#include "core/text_encoding.hpp"

namespace strake::report {
namespace {

/// Returns how many bytes at the start of UTF-8 are one blank that a spreadsheet skips: controls,
/// and the blanks, marks and separators of Unicode; 0 for anything that is visible.
std::size_t blank_length(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  if (text.empty()) return 0;
  if (byte(0) <= 0x20 || byte(0) == 0x7F) return 1;
  // U+0080 to U+00A0, and the soft hyphen.
  if (byte(0) == 0xC2 && (byte(1) <= 0xA0 || byte(1) == 0xAD)) return 2;
  // U+1680; U+2000 to U+200F and U+2028 to U+202F; U+205F to U+206F; U+3000; U+FEFF.
  for (const std::string_view first : {"\xE1\x9A\x80", "\xE3\x80\x80", "\xEF\xBB\xBF"})
    if (text.starts_with(first)) return 3;
  if (byte(0) != 0xE2) return 0;
  const bool spaces = byte(1) == 0x80 && (byte(2) <= 0x8F || (byte(2) >= 0xA8 && byte(2) <= 0xAF));
  return spaces || (byte(1) == 0x81 && byte(2) >= 0x9F && byte(2) <= 0xAF) ? 3 : 0;
}

/// Whether a spreadsheet takes a text for a formula; it takes the full-width signs of East Asian
/// keyboards for the plain ones.
bool is_like_formula(std::string_view text) {
  constexpr std::string_view kTabsAndBreaks = "\t\r\n";
  if (!text.empty() && kTabsAndBreaks.find(text.front()) != std::string_view::npos) return true;
  while (const std::size_t blank = blank_length(text)) text.remove_prefix(blank);
  for (const std::string_view sign :
       {"=", "+", "-", "@", "\xEF\xBC\x9D", "\xEF\xBC\x8B", "\xEF\xBC\x8D", "\xEF\xBC\xA0"})
    if (text.starts_with(sign)) return true;
  return false;
}

}  // namespace

void append_csv(std::string& out, std::string_view raw) {
  std::string text = valid_utf8(raw);
  if (is_like_formula(text)) text.insert(0, 1, '\'');
  // Where the comma is the decimal point, spreadsheets split cells at semicolons, or at tabs.
  if (text.find_first_of(",;\t\"\r\n") == std::string::npos) {
    out += text;
    return;
  }
  out += '"';
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  out += '"';
}

std::string_view without_apostrophe(std::string_view text) {
  const bool is_ours = text.starts_with('\'') && is_like_formula(text.substr(1));
  return is_ours ? text.substr(1) : text;
}

CsvRow& CsvRow::text(std::string_view raw) {
  append_csv(cell(), raw);
  return *this;
}

CsvRow& CsvRow::value(std::string_view raw) { return parse_number(raw) ? word(raw) : text(raw); }

CsvRow& CsvRow::word(std::string_view word) {
  cell() += word;
  return *this;
}

CsvRow& CsvRow::count(std::uint64_t number) { return word(std::to_string(number)); }

CsvRow& CsvRow::number(double value, AppendNumber append) {
  const std::size_t begin = cell().size();
  append(out_, value);
  if (form_.decimal == '.') return *this;
  const std::size_t point = out_.find('.', begin);
  if (point != std::string::npos) out_[point] = form_.decimal;
  return *this;
}

CsvRow& CsvRow::blank(std::size_t cells) {
  for (std::size_t i = 0; i < cells; ++i) cell();
  return *this;
}

}  // namespace strake::report
