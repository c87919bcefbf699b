// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "strake/core/result.hpp"

namespace strake::report {

/// A line of a CSV file, or several where a quoted cell has line breaks.
struct CsvRecord {
  std::size_t line = 0;            ///< where it begins, from 1 on
  std::vector<std::string> cells;  ///< as written, with quotes
  std::string end;                 ///< its line break; empty at the end of a file without one
};

/// A CSV file with its cells as they were written: what nobody changes is written back as it was.
struct CsvTable {
  bool mark = false;     ///< whether the byte order mark comes first
  char separator = ',';  ///< between cells: ',', ';' or a tab, whichever the first line has most of
  std::vector<CsvRecord> records;
};

/// Reads RFC 4180 with any of the three separators and any line breaks. Errors (input): what is not
/// UTF-8, a quote that is not closed, text behind a quoted cell; each with file and line.
[[nodiscard]] Result<CsvTable> parse_csv_table(std::string_view text, const std::string& name);

/// Returns the text of a file with such cells.
[[nodiscard]] std::string csv_text(const CsvTable& table);

/// Returns what a cell says: without its quotes, and without blanks round it.
[[nodiscard]] std::string cell_text(std::string_view cell);

/// Returns all that a cell says: without its quotes alone.
[[nodiscard]] std::string untrimmed_cell_text(std::string_view cell);

/// Whether no cell of a record says anything, as spreadsheets leave lines behind.
[[nodiscard]] bool is_blank(const CsvRecord& record);

}  // namespace strake::report
