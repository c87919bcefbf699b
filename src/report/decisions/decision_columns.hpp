// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "report/text/csv_table.hpp"
#include "strake/core/result.hpp"

namespace strake::report {

/// The columns of a decision file that the program knows, in the order in which it writes them.
enum class DecisionColumn : std::uint8_t {
  key,
  status,
  by,
  date,
  comment,
  cls,
  d,
  x,
  y,
  z,
  regions,
  test,
  a_file,
  a_id,
  a_name,
  b_file,
  b_id,
  b_name
};

inline constexpr std::array<std::string_view, 18> kDecisionColumns{
    "key",  "status",  "by",   "date",   "comment", "class",  "d_mm",   "x_mm", "y_mm",
    "z_mm", "regions", "test", "a_file", "a_id",    "a_name", "b_file", "b_id", "b_name"};

/// Returns what somebody wrote in quotes, for a message; a long text is cut.
[[nodiscard]] std::string in_quotes_cut(std::string_view text);

/// Where each of these columns stands in a file.
class DecisionColumns {
 public:
  /// Reads the headings: the first record, in any letter case. Errors (input): a column that is
  /// needed and missing, or there twice.
  [[nodiscard]] static Result<DecisionColumns> read(const CsvTable& table, const std::string& name);

  [[nodiscard]] bool has(DecisionColumn column) const { return at(column) != kNowhere; }
  /// Returns the number of a cell in its record; only for columns that are there.
  [[nodiscard]] std::size_t at(DecisionColumn column) const {
    return at_[static_cast<std::size_t>(column)];
  }
  void set(DecisionColumn column, std::size_t cell) {
    at_[static_cast<std::size_t>(column)] = cell;
  }
  /// Returns what a record says in a column; an empty text where it has no such cell.
  [[nodiscard]] std::string text(const CsvRecord& record, DecisionColumn column) const {
    return has(column) && at(column) < record.cells.size() ? cell_text(record.cells[at(column)])
                                                           : std::string();
  }
  /// Returns a name in a record as it was before it was written: blanks at its ends are its own.
  [[nodiscard]] std::string name(const CsvRecord& record, DecisionColumn column) const;
  /// Whether a record says nothing in any column that the program knows.
  [[nodiscard]] bool all_blank(const CsvRecord& record) const;

 private:
  static constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);
  DecisionColumns() { at_.fill(kNowhere); }

  std::array<std::size_t, kDecisionColumns.size()> at_{};
};

}  // namespace strake::report
