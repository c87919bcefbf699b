// SPDX-License-Identifier: Apache-2.0
// Where views lie on a sheet: arranged projections, and views placed by their own words.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "drawing/layout/view_plane.hpp"
#include "sheets/arrangement/free_place.hpp"
#include "sheets/spec/sheet_spec.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/context.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// Returns the view of a slot beside a front view, aligned with it wherever the two are placed.
///
/// `front` must look along an axis with `up` along another (ISO 5456-2).
[[nodiscard]] hlr::View view_in_slot(ViewSlot slot, const hlr::View& front);

/// A view to be placed: the extent of its lines about a common point of the model, and the paper
/// that it needs round them.
struct UnplacedView {
  ViewSlot slot = ViewSlot::none;
  drawing::PlaneBox extent;  ///< model mm
  double left_mm = 0, top_mm = 0, right_mm = 0, bottom_mm = 0;
  double min_width_mm = 0;  ///< the width that lines and captions need together

  /// Returns the paper that it covers where the common point falls on `at`.
  [[nodiscard]] PaperBox at(const PaperPoint& at, double scale) const;
};

struct Arranged {
  double scale = 1;
  bool fits = true;
  std::vector<PaperPoint> at;  ///< where the common point of each view falls
};

/// Places the views of an arrangement in first- or third-angle projection round the front view, in
/// columns and rows. Views of one column have the same x and views of one row the same y for each
/// point of the model, to the micrometre. The remaining paper is spread between and beside them, as
/// evenly as what is kept free allows. The pictorial view stands in the first free cell of the
/// columns and rows that leaves no side of the paper empty, or, where that makes all larger,
/// wherever it has room.
///
/// `scale` 0 takes the largest usual scale at which all fit, or the intermediate one above it where
/// they fit that. At a given scale that is too large
/// they are placed all the same, and `fits` is false.
/// Errors: input, where nothing fits at any scale.
[[nodiscard]] Result<Arranged> arrange(std::span<const UnplacedView> views, Projection projection,
                                       const SheetArea& room, double gap_mm, double scale);

/// The letter heights of captions and their distance below views: smaller up to A3.
struct Lettering {
  double title_mm = 5, scale_mm = 3.5, gap_mm = 4;
};
[[nodiscard]] Lettering lettering_of(const SheetSpec& what);

/// The place of a view on the sheet.
struct ViewPlace {
  geometry::Vec3l anchor;
  double scale = 1;
  PaperPoint at;   ///< where the anchor falls
  PaperBox lines;  ///< box of all lines, hidden ones too
  PaperBox whole;  ///< box with grid ends and caption
};

/// Returns the scale and place of each view: views of the arrangement by arrange(), others at their
/// own position; views without a scale share the largest one at which they fit, as in arrange().
/// Errors: input, where nothing fits at any scale; cancelled.
[[nodiscard]] Result<std::vector<ViewPlace>> place_views(const SheetSpec& what,
                                                         std::span<const hlr::Drawing> drawings,
                                                         const SheetArea& room,
                                                         const parallel::Context& context);

/// Estimates the scales that place_views() will give, from expected extents: those of views with
/// the same anchor, or none, are about the same point. Empty where nothing would fit.
[[nodiscard]] std::vector<double> expected_scales(const SheetSpec& what,
                                                  std::span<const drawing::PlaneBox> extents,
                                                  const SheetArea& room);

/// Returns the scale for the title block: that of the arrangement, or of most views. Views in
/// perspective have no say; empty: there are no others.
[[nodiscard]] std::optional<double> main_scale(const SheetSpec& what,
                                               std::span<const ViewPlace> places);

}  // namespace strake::sheets
