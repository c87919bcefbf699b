// SPDX-License-Identifier: Apache-2.0
// Where labels stand on a sheet: on free paper near their objects.
#pragma once

// Decision 0069 says why this way.

#include <cstddef>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "sheets/arrangement/view_arrangement.hpp"
#include "sheets/labels/paper/occupancy_grid.hpp"
#include "sheets/labels/placed_labels.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// A leader is no longer than this, and a text without one no farther from its object's middle.
inline constexpr double kLabelReachMm = 100;

/// A text, or a balloon, that wants a place.
struct LabelRequest {
  double width_mm = 0, height_mm = 2.5;  ///< of the text, or of the circle
  std::vector<PaperPoint> anchors;       ///< where a leader may end, the best first; not empty
  PaperBox object;                       ///< the box of the object's visible lines
  /// Stands on the object without a leader, if it covers nothing there.
  bool on_object = false;
  std::size_t view = 0;
  bool balloon = false;  ///< a circle at whose rim the leader ends, without a landing
  std::optional<PaperBox> within = std::nullopt;  ///< the label stands in this box
};

/// The paper on which labels are placed.
struct LabelGround {
  double width_mm = 420, height_mm = 297;
  const OccupancyGrid& occupied;  ///< lines, captions, grid bubbles; finished
  const SheetArea& room;
  std::vector<PaperBox> views;  ///< the boxes of the lines of all views
};

/// Returns the place of each label; none: it has no room within kLabelReachMm.
///
/// No text touches another text, a leader or a line of the ground. Leaders cross each other only
/// where the search found no place with a little more of leader that avoids it.
///
/// Labels get the cheapest place on a lattice about their anchors one after the other. Labels
/// without room then drive out one that finds another place; and labels with crossed leaders are
/// placed anew, alone and in pairs, as long as that makes the sheet cheaper. The order of the
/// requests decides between equals.
///
/// The work is counted and limited, for all labels together: it takes less than about a second for
/// any number of them, of which more than some hundreds look less far. Triggered, `stop` leaves all
/// that has no place yet without one.
[[nodiscard]] std::vector<std::optional<LabelPlace>> place_labels(
    std::span<const LabelRequest> requests, const LabelGround& ground, const std::stop_token& stop);

}  // namespace strake::sheets
