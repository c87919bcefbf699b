// SPDX-License-Identifier: Apache-2.0
// Tags that lie along what they name, as the numbers of pipes do: where an object runs straight on,
// and where its tag has room there.
#pragma once

#include <optional>
#include <string>

#include "sheets/arrangement/free_place.hpp"
#include "sheets/labels/paper/line_bins.hpp"
#include "sheets/labels/paper/occupancy_grid.hpp"
#include "strake/model/model.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// Finds places for texts along the straight runs of objects, one after the other. What it is given
/// must outlive it.
class AlongTags {
 public:
  /// `occupied` knows what blocks the sheet, and takes note of the texts that find a place.
  AlongTags(const Sheet& sheet, const model::Model& model, const SheetArea& room,
            OccupancyGrid& occupied);

  /// Returns the tag of an object on one of its runs that is longer than the text: above the line,
  /// or in the middle of a pipe without a centre line where it has room there; as near to the
  /// middle of the run as it covers nothing; to be read from below or from the right (ISO 129-1).
  /// None: there is no such place.
  [[nodiscard]] std::optional<Text> place(const PlacedView& view, model::ObjectId object,
                                          const std::string& text, double height_mm);

 private:
  [[nodiscard]] bool is_free(const Text& text, double width_mm, const PaperPoint& way) const;
  void take(const Text& text);

  const model::Model& model_;
  const SheetArea& room_;
  OccupancyGrid& occupied_;
  LineBins lines_;
};

}  // namespace strake::sheets
