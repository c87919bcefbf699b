// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "strake/geometry/vec.hpp"

namespace strake::report {

/// Returns the coordinates of a place as all tables show them: whole millimetres.
[[nodiscard]] std::array<std::string, 3> place_text(const geometry::Vec3d& mm);

/// One of the two objects of a row.
struct RowSide {
  std::string_view source;  ///< its file or discipline; empty where there is only one
  std::string_view name;
};

/// A result as the table shows it. Texts are printable but for those of the sides.
struct PairRow {
  std::string_view cls;
  std::string_view status = {};  ///< what was decided; empty where nothing is known of that
  std::string d;
  std::string range, volume;  ///< empty where there is nothing to show
  std::string_view relation;
  std::array<std::string, 3> place_mm;
  RowSide a, b;
};

/// Rows of one class, and the line that says how many more there are; empty: none.
struct PairBlock {
  std::vector<PairRow> rows;
  std::string more;
};

/// What stands over the columns, beside what is the same in every table.
struct PairTableHead {
  std::string_view source;  ///< "file" or "discipline"; empty: there is no such column
  bool volume = false;      ///< whether there is a column for the volume
  std::size_t width = 100;  ///< columns of the terminal
};

/// Returns the rows as text, with a head where there are any. The path that all names begin with is
/// told once and left out. Where the two names of every row fit beside the numbers they stand
/// there, else b stands below a, and where that does not fit either both stand below the numbers; a
/// name is cut only where it is wider than the terminal, and only so that it still looks unlike all
/// others.
[[nodiscard]] std::string pair_table(std::span<const PairBlock> blocks, const PairTableHead& head);

}  // namespace strake::report
