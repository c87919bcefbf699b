// SPDX-License-Identifier: Apache-2.0
#include "drawing/dxf/paper_space.hpp"

#include <vector>

#include "drawing/layout/view_plane.hpp"

namespace strake::drawing::dxf {

PaperSpace::PaperSpace(const PaperSize& size, std::span<const LayerStyle> layers,
                       std::size_t viewport_layer, Handle block, Handle first)
    : height_mm_(size.height_mm),
      block_(block),
      layers_(layers),
      viewport_layer_(viewport_layer),
      next_(first) {
  const PaperPoint middle{size.width_mm / 2, size.height_mm / 2};
  append_viewport(text_, head(viewport_layer_),
                  {middle, size.width_mm, size.height_mm, middle, size.height_mm}, viewports_++);
}

void PaperSpace::add_viewport(const PaperFrame& window, const PaperPoint& target, double scale) {
  const double width = window.right - window.left, height = window.bottom - window.top;
  append_viewport(text_, head(viewport_layer_),
                  {up({(window.left + window.right) / 2, (window.top + window.bottom) / 2}), width,
                   height, target, height * scale},
                  viewports_++);
}

void PaperSpace::add_lines(std::size_t layer, std::span<const PaperPoint> points) {
  const bool dashed = !layers_[layer].dash_mm.empty();
  const std::vector<PaperPoint> there = all_up(points);
  if (there.size() == 2) return append_line(text_, head(layer), there.front(), there.back());
  if (there.size() > 2) append_polyline(text_, head(layer), there, dashed);
}

void PaperSpace::add_filled(std::size_t layer, std::span<const PaperPoint> points) {
  if (points.size() > 1 && points.front() == points.back())
    points = points.first(points.size() - 1);
  if (points.size() > 2) append_filled(text_, head(layer), all_up(points));
}

void PaperSpace::add_circle(std::size_t layer, const PaperPoint& centre, double radius_mm) {
  append_circle(text_, head(layer), up(centre), radius_mm);
}

void PaperSpace::add_text(std::size_t layer, const TextPlace& place, std::string_view text) {
  // An audit throws texts of nothing away.
  if (text.empty()) return;
  TextPlace there = place;
  there.at = up(place.at);
  append_text(text_, head(layer), there, text);
}

void PaperSpace::add_cover(std::size_t layer, const CoverCorners& corners) {
  append_cover(text_, head(layer),
               {up(corners.lower_left), up(corners.lower_right), up(corners.upper_left)});
}

EntityHead PaperSpace::head(std::size_t layer) {
  return {Space::paper, next_++, layers_[layer].name, 1, block_, pen_};
}

PaperPoint PaperSpace::up(const PaperPoint& p) const {
  return {rounded_paper(p.x), rounded_paper(height_mm_ - p.y)};
}

std::vector<PaperPoint> PaperSpace::all_up(std::span<const PaperPoint> points) const {
  std::vector<PaperPoint> there;
  for (const PaperPoint& point : points) there.push_back(up(point));
  return there;
}

}  // namespace strake::drawing::dxf
