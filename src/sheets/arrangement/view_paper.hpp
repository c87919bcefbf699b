// SPDX-License-Identifier: Apache-2.0
// Where the model lies on the paper of a view, for what is drawn beside its lines.
#pragma once

#include <algorithm>
#include <optional>

#include "drawing/layout/view_plane.hpp"
#include "sheets/arrangement/view_arrangement.hpp"
#include "sheets/spec/sheet_spec.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// A view and its place on paper.
struct MarkedView {
  const ViewSpec& spec;
  const drawing::Placement& placement;
  const PaperBox& lines;     ///< box of all its lines
  const PaperBox& labelled;  ///< that with its dimensions, and the labels of its grid and levels
};

/// The wide end of a cutting plane.
inline constexpr double kWideEndMm = 6;

/// Returns how far a cutting plane goes beyond the lines of a view where labels take so much of the
/// paper beside them: its wide end lies beyond the labels.
[[nodiscard]] inline double reach_of_plane(double labels_mm) {
  constexpr double kMinMm = 8, kApartMm = 1;
  return std::max(labels_mm + kApartMm + kWideEndMm, kMinMm);
}

[[nodiscard]] inline PaperPoint rounded(const PaperPoint& p) {
  return {drawing::rounded_paper(p.x), drawing::rounded_paper(p.y)};
}

/// Returns the point so many millimetres from another.
[[nodiscard]] inline PaperPoint along(const PaperPoint& p, const PaperPoint& way, double mm) {
  return {p.x + way.x * mm, p.y + way.y * mm};
}

/// The paper of a view without perspective.
class ViewPaper {
 public:
  explicit ViewPaper(const MarkedView& in) : in_(in), axes_(drawing::paper_axes(in.spec.view)) {}

  /// Whether the view has axes and no perspective; nothing else may be asked of one that has.
  [[nodiscard]] bool good() const { return axes_ && !axes_->eye; }
  /// Returns a vector of the model, on paper at 1:1.
  [[nodiscard]] PaperPoint vector(const geometry::Vec3d& v) const {
    return {dot(axes_->right, v), -dot(axes_->up, v)};
  }
  [[nodiscard]] PaperPoint point(const geometry::Vec3d& mm) const {
    const PaperPoint v = vector(mm - geometry::to_mm(in_.placement.anchor));
    const double scale = in_.placement.sheet.scale;
    return {in_.placement.at.x + v.x / scale, in_.placement.at.y + v.y / scale};
  }
  /// Returns how far a length of paper is in the model, mm.
  [[nodiscard]] double in_model(double paper_mm) const {
    return paper_mm * in_.placement.sheet.scale;
  }

 private:
  const MarkedView& in_;
  std::optional<drawing::PaperAxes> axes_;
};

}  // namespace strake::sheets
