// SPDX-License-Identifier: Apache-2.0
#include "drawing/dxf/model_plane.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace strake::drawing::dxf {

namespace {

struct ProjectedEnd {
  geometry::Vec3d mm;
  PaperPoint paper;
};
std::array<ProjectedEnd, 2> ends_of(const Line& line) {
  return {ProjectedEnd{line.a_mm, line.a_paper}, ProjectedEnd{line.b_mm, line.b_paper}};
}

}  // namespace

ModelPlane::ModelPlane(const NeutralDrawing& drawing, const Ink& ink)
    : there_{0, drawing.sheet.height_mm} {
  const std::vector<Line>& lines = ink.in_model_space();
  if (!drawing.view.perspective) axes_ = paper_axes(drawing.view);
  if (axes_) scale_ = drawing.sheet.scale;
  if (axes_ && !lines.empty()) {
    // Ends are rounded on paper: their mean is known much better than any of them.
    paper_ = lines.front().a_paper;
    there_ = true_place(lines.front().a_mm);
    double x = 0, y = 0;
    for (const Line& line : lines)
      for (const ProjectedEnd& end : ends_of(line)) {
        const PaperPoint there = true_place(end.mm);
        x += end.paper.x - paper_.x - (there.x - there_.x) / scale_;
        y += end.paper.y - paper_.y + (there.y - there_.y) / scale_;
      }
    const double ends = 2 * static_cast<double>(lines.size());
    paper_ = {paper_.x + x / ends, paper_.y + y / ends};
  }
  for (const Line& line : lines)
    for (const ProjectedEnd& end : ends_of(line)) include(end.paper, place(end.mm, end.paper));
  for (const CentreLine& line : ink.centre_lines)
    for (const PaperPoint& point : line.points) include(point, place(point));
  for (const BreakLine& line : ink.break_lines)
    for (const PaperPoint& point : line.points) include(point, place(point));
}

void ModelPlane::include(const PaperPoint& paper, const PaperPoint& there) {
  extent_.include(there);
  on_paper_.left = std::min(on_paper_.left, paper.x);
  on_paper_.top = std::min(on_paper_.top, paper.y);
  on_paper_.right = std::max(on_paper_.right, paper.x);
  on_paper_.bottom = std::max(on_paper_.bottom, paper.y);
}

PaperPoint ModelPlane::true_place(const geometry::Vec3d& mm) const {
  return {dot(axes_->right, mm), dot(axes_->up, mm)};
}

PaperPoint ModelPlane::from_paper(const PaperPoint& paper) const {
  return {there_.x + (paper.x - paper_.x) * scale_ + moved_.x,
          there_.y - (paper.y - paper_.y) * scale_ + moved_.y};
}

PaperPoint ModelPlane::place(const geometry::Vec3d& mm, const PaperPoint& paper) const {
  if (!axes_) return place(paper);
  const PaperPoint there = true_place(mm);
  return {rounded_paper(there.x + moved_.x), rounded_paper(there.y + moved_.y)};
}

PaperPoint ModelPlane::place(const PaperPoint& paper) const {
  const PaperPoint there = from_paper(paper);
  return {rounded_paper(there.x), rounded_paper(there.y)};
}

PaperCurves ModelPlane::curves(const PaperCurves& on_paper) const {
  PaperCurves curves = on_paper;
  for (PaperCurve& curve : curves.all)
    curve = {from_paper(curve.centre),
             {curve.u.x * scale_, -curve.u.y * scale_},
             {curve.v.x * scale_, -curve.v.y * scale_}};
  return curves;
}

void ModelPlane::move(double x, double y) {
  moved_.x += x;
  moved_.y += y;
  extent_.left += x;
  extent_.right += x;
  extent_.bottom += y;
  extent_.top += y;
}

}  // namespace strake::drawing::dxf
