// SPDX-License-Identifier: Apache-2.0
// The labels of a sheet, tags and balloons, placed together and written.
#pragma once

#include <stop_token>
#include <vector>

#include "sheets/arrangement/free_place.hpp"
#include "sheets/labels/balloons.hpp"
#include "sheets/labels/tags.hpp"
#include "strake/core/result.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

struct SheetLabels {
  std::vector<TagList> tags;
  std::vector<BalloonList> balloons;
};

/// Writes the labels of a sheet: first those that lie along their objects (along_tags.hpp), then
/// the others, all together, on free paper near their objects, with leaders, or plainly on their
/// objects where nothing is covered there (label_placement.hpp). A label that finds no room is left
/// out and counted. Errors: cancelled.
[[nodiscard]] Status write_labels(SheetLabels& labels, const model::Model& model,
                                  const SheetArea& room, Sheet& sheet, const std::stop_token& stop);

}  // namespace strake::sheets
