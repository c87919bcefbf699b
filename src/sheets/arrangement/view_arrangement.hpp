// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "drawing/layout/view_plane.hpp"
#include "sheets/spec/sheet_spec.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/context.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// The view that stands in a slot beside a front view: aligned with it wherever one places them.
///
/// `front` looks along an axis, its `up` is another. (ISO 5456-2)
[[nodiscard]] hlr::View view_in_slot(ViewSlot slot, const hlr::View& front);

/// A view to be placed: its lines about a common point of the model, and the paper that it needs
/// round them.
struct UnplacedView {
  ViewSlot slot = ViewSlot::none;
  drawing::PlaneBox extent;  ///< model mm
  double left_mm = 0, top_mm = 0, right_mm = 0, bottom_mm = 0;
  double least_width_mm = 0;  ///< of lines and captions together

  /// What it covers where the common point falls on `at`.
  [[nodiscard]] PaperBox at(const PaperPoint& at, double scale) const;
};

/// Where views may lie.
struct SheetArea {
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
[[nodiscard]] Result<Arranged> arrange(std::span<const UnplacedView> views, Projection projection,
                                       const SheetArea& room, double gap_mm, double scale);

/// Letters of the captions below views, and how far below: smaller ones up to A3.
struct Lettering {
  double title_mm = 5, scale_mm = 3.5, gap_mm = 4;
};
[[nodiscard]] Lettering lettering_of(const SheetSpec& what);

/// Where a view comes to lie.
struct ViewPlace {
  geometry::Vec3l anchor;
  double scale = 1;
  PaperPoint at;   ///< where the anchor falls
  PaperBox lines;  ///< of all lines, hidden ones too
  PaperBox whole;  ///< with grid ends and caption
};

/// Gives each view its scale and place: those of the arrangement by arrange(), others where they
/// say, and views without a scale the largest usual one that is common to them and at which they
/// fit.
/// Errors: input, where nothing fits at any scale; cancelled.
[[nodiscard]] Result<std::vector<ViewPlace>> place_views(const SheetSpec& what,
                                                         std::span<const hlr::Drawing> drawings,
                                                         const SheetArea& room,
                                                         const parallel::Context& context);

/// About the scales that place_views() will give, from extents that are expected: views with the
/// same anchor, or none, about the same point. Nothing where nothing would fit.
[[nodiscard]] std::vector<double> expected_scales(const SheetSpec& what,
                                                  std::span<const drawing::PlaneBox> extents,
                                                  const SheetArea& room);

/// The scale for the title block: that of the arrangement, or of most views.
[[nodiscard]] double main_scale(const SheetSpec& what, std::span<const ViewPlace> places);

}  // namespace strake::sheets
