// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "drawing/dxf/document.hpp"
#include "drawing/layout/view_plane.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::drawing::dxf {

/// Where a view lies in model space: at true size, in mm of the model along the axes of its plane
/// from the model's origin, y upwards; a view in perspective, which has no true size, in mm of
/// paper from the lower left corner of its sheet.
class ModelPlane {
 public:
  /// From the places of the lines that are drawn it finds where curves and centre lines lie.
  ModelPlane(const NeutralDrawing& drawing, const Ink& ink);

  /// How many mm a mm of paper is.
  [[nodiscard]] double scale() const { return scale_; }
  /// What the lines and centre lines fill, in model space and on paper.
  [[nodiscard]] const DxfExtent& extent() const { return extent_; }
  [[nodiscard]] const PaperFrame& on_paper() const { return on_paper_; }

  [[nodiscard]] PaperPoint from_paper(const PaperPoint& paper) const;
  /// Returns an end of a line, to a whole micrometre.
  [[nodiscard]] PaperPoint place(const geometry::Vec3d& mm, const PaperPoint& paper) const;
  /// Returns a point of paper, to a whole micrometre.
  [[nodiscard]] PaperPoint place(const PaperPoint& paper) const;
  [[nodiscard]] PaperCurves curves(const PaperCurves& on_paper) const;

  void move(double x, double y);

 private:
  /// Makes the extents hold a point, which lies there in model space.
  void include(const PaperPoint& paper, const PaperPoint& there);
  [[nodiscard]] PaperPoint true_place(const geometry::Vec3d& mm) const;

  std::optional<PaperAxes> axes_;  ///< nothing: mm of paper
  double scale_ = 1;
  PaperPoint paper_, there_;  ///< a point on paper, and where it lies in model space before a move
  PaperPoint moved_;
  DxfExtent extent_;
  PaperFrame on_paper_{kFarthestPaperMm, kFarthestPaperMm, -kFarthestPaperMm, -kFarthestPaperMm};
};

}  // namespace strake::drawing::dxf
