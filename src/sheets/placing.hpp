// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "sheets/arrangement.hpp"
#include "sheets/description.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/context.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// Letters of the captions below views, and how far below: smaller ones up to A3.
struct Lettering {
  double title_mm = 5, scale_mm = 3.5, gap_mm = 4;
};
[[nodiscard]] Lettering lettering_of(const Description& what);

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
[[nodiscard]] Result<std::vector<ViewPlace>> place_views(const Description& what,
                                                         std::span<const hlr::Drawing> drawings,
                                                         const Room& room,
                                                         const parallel::Context& context);

/// About the scales that place_views() will give, from extents that are expected: views with the
/// same anchor, or none, about the same point. Nothing where nothing would fit.
[[nodiscard]] std::vector<double> expected_scales(const Description& what,
                                                  std::span<const drawing::PlaneBox> extents,
                                                  const Room& room);

/// The scale for the title block: that of the arrangement, or of most views.
[[nodiscard]] double main_scale(const Description& what, std::span<const ViewPlace> places);

}  // namespace strake::sheets
