// SPDX-License-Identifier: Apache-2.0
// Where a view lies on its sheet, from a box on its plane.
#pragma once

#include <optional>

#include "drawing/layout/view_plane.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::drawing {

/// Errors: usage for a scale that is none.
[[nodiscard]] Status check_scale(const LayoutOptions& options);

/// Places the middle of a box in the middle of a sheet; `origin` is what the box is about.
[[nodiscard]] Placement in_the_middle(const PlaneBox& box, const Sheet& sheet,
                                      const geometry::Vec3l& origin);

/// Chooses sheet and scale for a box and places it in the middle. Errors: usage, where it does not
/// fit the paper that was requested.
[[nodiscard]] Result<Placement> choose_placement(const PlaneBox& box, const geometry::Vec3l& origin,
                                                 const LayoutOptions& options);

/// Points of the model on the sheet.
class PaperPlane {
 public:
  PaperPlane(const PaperAxes& axes, const Placement& placement)
      : plane_(axes, placement.anchor), at_(placement.at), scale_(placement.sheet.scale) {}

  /// Returns the place, rounded, and clamped to what files can express: clipped lines may lie
  /// anywhere, even behind the eye.
  [[nodiscard]] PaperPoint operator()(const geometry::Vec3l& grid) const;
  /// Returns by how much a micrometre of the model at a point shows on paper at most, mm.
  [[nodiscard]] double grid_on_paper(const geometry::Vec3l& grid) const;

 private:
  ViewPlane plane_;
  PaperPoint at_;
  double scale_;
};

/// Returns the frame round the lines of a view in perspective: where the field of view ends, or a
/// little beside the lines that end before; nothing for other views and without lines.
[[nodiscard]] std::optional<PaperFrame> frame_of(const NeutralDrawing& drawing,
                                                 const Placement& placement);

}  // namespace strake::drawing
