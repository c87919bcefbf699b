// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/report/clash.hpp"
#include "workbook/sheet/sheet_row.hpp"

/// Spreadsheets of Excel and others (ECMA-376, .xlsx), written from front to back: rows are made
/// and packed by many workers, and none is kept (decision 0082).
namespace strake::workbook {

struct SheetColumn {
  std::string name;   ///< its head; all empty: the sheet has none
  double width = 10;  ///< in characters
};

/// A picture in a cell.
struct SheetPicture {
  std::size_t row = 0, column = 0;  ///< from 0 on, the row of heads included
  std::string png;
};

struct Worksheet {
  std::string name;  ///< at most 31 characters, none of []:*?/\, no other sheet has it
  std::vector<SheetColumn> columns;
  std::size_t rows = 0;  ///< below the heads
  /// Appends the cells of row `i` of these; called by many workers at once.
  std::function<void(std::size_t i, SheetRow& row)> cells;
  /// Columns whose words have colours: classes, and statuses, which a person picks from a list.
  std::optional<std::size_t> class_column = {}, status_column = {};
  double row_height = 0;  ///< in points; 0: as the program has it
  std::vector<SheetPicture> pictures = {};

  [[nodiscard]] bool has_heads() const { return !columns.empty() && !columns.front().name.empty(); }
};

/// How large a PNG says that it is; nothing where the bytes are none.
struct PictureSize {
  std::uint32_t width = 0, height = 0;
};
[[nodiscard]] std::optional<PictureSize> size_of_png(std::string_view png);

/// Appends a sheet to others, and where it has more rows than `max_rows` below its heads the rest
/// as further ones, "Clashes 2" and so on.
void append_split(std::vector<Worksheet>& sheets, const Worksheet& whole,
                  std::size_t max_rows = kMaxRows - 1);

/// Writes a workbook. The bytes depend on the sheets alone: not on the team, the time or the
/// locale. Errors: output where a sheet or all of it has 4 GiB; memory, cancelled.
[[nodiscard]] Status write_workbook(std::span<const Worksheet> sheets, report::Sink sink,
                                    const parallel::Context& context);

}  // namespace strake::workbook
