// SPDX-License-Identifier: Apache-2.0
#include "drawing/layout/placement.hpp"

#include <algorithm>
#include <cmath>

#include "strake/geometry/grid.hpp"

namespace strake::drawing {

namespace {

double paper_coordinate(double mm) {
  return rounded_paper(std::clamp(mm, -kFarthestPaperMm, kFarthestPaperMm));
}

}  // namespace

Status check_scale(const LayoutOptions& options) {
  if (!options.scale || (*options.scale > 0 && std::isfinite(*options.scale))) return {};
  return Error{ErrorCode::usage, "the scale is not a positive number", "", "use 1:50, say"};
}

Placement in_the_middle(const PlaneBox& box, const Sheet& sheet, const geometry::Vec3l& origin) {
  return {sheet,
          origin,
          {sheet.width_mm / 2 - (box.left + box.width() / 2) / sheet.scale,
           (sheet.height_mm - kTitleStrip) / 2 + (box.bottom + box.height() / 2) / sheet.scale}};
}

Result<Placement> choose_placement(const PlaneBox& box, const geometry::Vec3l& origin,
                                   const LayoutOptions& options) {
  const Sheet sheet = choose_sheet(box, options);
  if (!(std::max(sheet.width_mm, sheet.height_mm) <= kFarthestPaperMm))
    return Error{ErrorCode::usage, "the sheet would be more than 1,000 km wide", "",
                 "give a smaller --scale, or let it be chosen"};
  if (options.paper)
    if (const Status status = check_fit(box, sheet, options); !status) return status.error();
  return in_the_middle(box, sheet, origin);
}

PaperPoint PaperPlane::operator()(const geometry::Vec3l& grid) const {
  const PlanePoint p = plane_(grid);
  return {paper_coordinate(at_.x + p.x / scale_), paper_coordinate(at_.y - p.y / scale_)};
}

double PaperPlane::grid_on_paper(const geometry::Vec3l& grid) const {
  return geometry::kMmPerGrid * plane_(grid).magnification / scale_;
}

std::optional<PaperFrame> frame_of(const NeutralDrawing& drawing, const Placement& placement) {
  const auto field = field_of_view(drawing.view, placement.anchor);
  if (!field) return std::nullopt;
  PaperFrame frame{kFarthestPaperMm, kFarthestPaperMm, -kFarthestPaperMm, -kFarthestPaperMm};
  for (const Line& line : drawing.lines) {
    if (line.state == LineState::clipped) continue;
    for (const PaperPoint& end : {line.a_paper, line.b_paper}) {
      frame.left = std::min(frame.left, end.x - kFrameGapMm);
      frame.top = std::min(frame.top, end.y - kFrameGapMm);
      frame.right = std::max(frame.right, end.x + kFrameGapMm);
      frame.bottom = std::max(frame.bottom, end.y + kFrameGapMm);
    }
  }
  if (frame.left > frame.right) return std::nullopt;
  const double scale = placement.sheet.scale;
  const PaperPoint& at = placement.at;
  return PaperFrame{paper_coordinate(std::max(frame.left, at.x + field->left / scale)),
                    paper_coordinate(std::max(frame.top, at.y - field->top / scale)),
                    paper_coordinate(std::min(frame.right, at.x + field->right / scale)),
                    paper_coordinate(std::min(frame.bottom, at.y - field->bottom / scale))};
}

}  // namespace strake::drawing
