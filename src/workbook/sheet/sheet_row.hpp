// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace strake::workbook {

/// How a cell looks; the numbers are those of the formats in the part of styles.
enum class CellStyle : std::uint8_t {
  plain,
  head,    ///< of a column: bold, on a ground
  title,   ///< bold and large
  text,    ///< what was given: never a formula, whatever a person does to the cell
  length,  ///< a number with three decimals
  whole,   ///< a number without any
  bold,
};

/// The most rows of a sheet, the row of heads included, and the most UTF-16 words of a cell.
inline constexpr std::size_t kMaxRows = 1048576, kMaxCellWords = 32767;

/// Returns the name of a column, from 0 on: "A", "Z", "AA".
[[nodiscard]] std::string column_name(std::size_t column);

/// Appends a text as a cell has it: XML, without what XML cannot have or what changes the direction
/// of writing, which becomes U+FFFD, and cut where it is longer than a cell may be. Line breaks
/// stay.
void append_cell_text(std::string& out, std::string_view raw);

/// Appends the cells of a row one by one.
class SheetRow {
 public:
  /// Appends a number to a text, with a decimal point.
  using AppendNumber = void (*)(std::string& out, double value);

  /// `number` counts rows from 0 on; `height` is in points, 0: that of the sheet.
  SheetRow(std::string& out, std::size_t number, int height = 0);

  /// Appends a name from a file, whatever it is as text.
  SheetRow& text(std::string_view raw) { return string(raw, CellStyle::text); }
  /// Appends the value of an attribute: a number where it is one.
  SheetRow& value(std::string_view raw);
  /// Appends a word of ours.
  SheetRow& word(std::string_view word, CellStyle style = CellStyle::plain) {
    return string(word, style);
  }
  SheetRow& count(std::uint64_t number);
  SheetRow& number(double value, AppendNumber append);
  SheetRow& blank(std::size_t cells = 1) {
    column_ += cells;
    return *this;
  }
  void end() { out_ += "</row>"; }

 private:
  void begin_cell(CellStyle style);
  SheetRow& string(std::string_view text, CellStyle style);

  std::string& out_;
  std::string number_;  ///< of the row, as references have it
  std::size_t column_ = 0;
};

}  // namespace strake::workbook
