// SPDX-License-Identifier: Apache-2.0
// Balloons: the numbers of a parts list in circles, at objects that views show (ISO 6433).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "sheets/labels/visible_objects.hpp"
#include "sheets/spec/sheet_spec.hpp"
#include "strake/model/model.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// The number of a row and the object that stands for it.
struct Balloon {
  std::string number;
  VisibleObject visible;
  std::size_t view = 0;  ///< index into Sheet::views
};

/// The balloons of one list.
struct BalloonList {
  const PartsListSpec* spec = nullptr;  ///< one with balloons
  double letters_mm = 3.5;              ///< height of the numbers, the same in all circles
  std::vector<Balloon> all;             ///< in the order of the rows
  /// The numbers of rows of which no view shows an object, and of those without room.
  std::vector<std::string> unseen, crowded;
};

/// Returns the balloons of a list, one for each row: at the object that shows most of those in the
/// first of its views that shows any. `listed` are the objects of the rows, in the order of their
/// numbers from 1.
[[nodiscard]] BalloonList balloons_of(const PartsListSpec& spec,
                                      std::span<const std::vector<model::ObjectId>> listed,
                                      std::size_t objects, const Sheet& sheet);

/// Returns the paper of a view on which its balloons may stand: all that lies on one side of its
/// lines.
[[nodiscard]] PaperBox paper_beside(const PaperBox& lines, BalloonSpec::Side side,
                                    const Sheet& sheet);

}  // namespace strake::sheets
