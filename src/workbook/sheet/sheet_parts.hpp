// SPDX-License-Identifier: Apache-2.0
// The parts of a workbook that are XML and not rows.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "workbook/sheet/workbook.hpp"

namespace strake::workbook {

/// A file of the archive.
struct PackagePart {
  std::string name, text;
};

/// Returns all parts but the sheets: which parts there are, how they hang together, formats,
/// pictures. Those that a reader looks for first come first.
[[nodiscard]] std::vector<PackagePart> workbook_parts(std::span<const Worksheet> sheets);

/// Returns the name of the part of sheet number `sheet`, from 0 on.
[[nodiscard]] std::string sheet_part(std::size_t sheet);

/// Returns what stands before the rows of a sheet, the row of heads included, and behind them.
[[nodiscard]] std::string sheet_head(const Worksheet& sheet, bool is_first);
[[nodiscard]] std::string sheet_tail(const Worksheet& sheet);

}  // namespace strake::workbook
