// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sheets/annotation/occupancy_grid.hpp"
#include "sheets/arrangement/view_arrangement.hpp"
#include "sheets/spec/sheet_spec.hpp"
#include "strake/model/model.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// Returns whether texts of tags may use a name: name, id, path, file, type or @ATTRIBUTE.
[[nodiscard]] bool is_tag_name(std::string_view name);

/// What became of the tags of one table in one view.
struct TagCount {
  std::size_t written = 0;
  std::size_t unseen = 0;   ///< objects without a visible line
  std::size_t blank = 0;    ///< objects that lack every value that the text names
  std::size_t partly = 0;   ///< objects that lack some of the values
  std::size_t crowded = 0;  ///< tags that found no room
};

/// Writes tags at the picked and visible objects of a view: on free paper near the longest line of
/// each, with a leader, or plainly in its middle. No two texts touch; a tag that finds no room is
/// left out and counted.
///
/// Objects come in the order of the model, so that the places of tags do not depend on the team.
[[nodiscard]] TagCount write_tags(const TagSpec& spec, const std::vector<bool>& picked,
                                  const model::Model& model, const SheetArea& room,
                                  PlacedView& view, OccupancyGrid& occupancy);

}  // namespace strake::sheets
