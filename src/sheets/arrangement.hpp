// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "drawing/paper.hpp"
#include "sheets/description.hpp"
#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// The view that stands in a slot beside a front view: aligned with it wherever one places them.
///
/// `front` looks along an axis, its `up` is another. (ISO 5456-2)
[[nodiscard]] hlr::View view_in_slot(Slot slot, const hlr::View& front);

/// A view to be placed: its lines about a common point of the model, and the paper that it needs
/// round them.
struct ToPlace {
  Slot slot = Slot::none;
  drawing::PlaneBox extent;  ///< model mm
  double left_mm = 0, top_mm = 0, right_mm = 0, bottom_mm = 0;
  double least_width_mm = 0;  ///< of lines and captions together

  /// What it covers where the common point falls on `at`.
  [[nodiscard]] PaperBox at(const PaperPoint& at, double scale) const;
};

/// Where views may lie.
struct Room {
  PaperBox area;
  std::vector<PaperBox> keep_free;

  [[nodiscard]] bool takes(const PaperBox& box) const;
};

struct Arranged {
  double scale = 1;
  bool fits = true;
  std::vector<PaperPoint> at;  ///< where the common point of each view falls
};

/// Places the views of an arrangement in first- or third-angle projection round the front view: in
/// columns and rows, those of one column with the same x and those of one row with the same y for
/// each point of the model, to the micrometre. The pictorial view goes to the free place that
/// leaves the others the largest scale.
///
/// `scale` 0: the largest usual one at which all fit. At a scale that is given and too large they
/// are placed all the same, and `fits` is false.
/// Errors: input, where nothing fits at any scale.
[[nodiscard]] Result<Arranged> arrange(std::span<const ToPlace> views, Projection projection,
                                       const Room& room, double gap_mm, double scale);

}  // namespace strake::sheets
