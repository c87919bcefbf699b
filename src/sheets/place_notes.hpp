// SPDX-License-Identifier: Apache-2.0
// The notes of a sheet, which stand beside its views: scale bar, north, lists, revisions.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sheets/annotation/note_table.hpp"
#include "sheets/arrangement/free_place.hpp"
#include "sheets/spec/sheet_spec.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/model/model.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// Where the notes of a sheet stand.
struct Notes {
  std::vector<std::pair<NoteTable, PaperPoint>> tables;  ///< with their upper left corners
  /// The objects of the rows that each parts list shows.
  std::vector<std::vector<std::vector<model::ObjectId>>> listed;
  std::optional<PaperPoint> scale_bar;  ///< its upper left corner
  std::optional<PaperPoint> north;      ///< its middle
};

/// Places the notes before the views, and keeps their paper free of these: lists at the upper right
/// from top to bottom, north below them, revisions on the title block, the scale bar at the lower
/// left, or where the file says. `picks` are the objects of each parts list. Rows without room are
/// left out and warned of.
[[nodiscard]] Notes plan_notes(const SheetSpec& what, const model::Model& model,
                               std::span<const std::vector<bool>> picks, SheetArea& room,
                               Diagnostics& diagnostics);

/// Draws them. A sheet without a scale has no scale bar, one without a view that shows north no
/// north mark; both are warned of.
void draw_notes(const Notes& notes, const SheetSpec& what, std::optional<double> scale,
                Sheet& sheet);

}  // namespace strake::sheets
