// SPDX-License-Identifier: Apache-2.0
#include "drawing/dxf/sheet_file.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "drawing/dxf/document.hpp"
#include "drawing/dxf/model_plane.hpp"
#include "drawing/dxf/view_lines.hpp"

namespace strake::drawing::dxf {

namespace {

/// A view with its place in model space and the window of the sheet that shows it.
struct PlacedView {
  const SheetView* view;
  ModelPlane plane;
  PaperFrame window;
};

/// Returns whole millimetres round the lines, with room for half a pen.
PaperFrame window_of(const ModelPlane& plane) {
  const auto& [left, top, right, bottom] = plane.on_paper();
  return {std::floor(left - 1), std::floor(top - 1), std::ceil(right + 1), std::ceil(bottom + 1)};
}

PaperPoint middle_of(const PaperFrame& window) {
  return {(window.left + window.right) / 2, (window.top + window.bottom) / 2};
}

bool overlap(const PaperFrame& a, const PaperFrame& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

bool any_overlap(const std::vector<PlacedView>& views) {
  for (std::size_t i = 0; i < views.size(); ++i)
    for (std::size_t k = i + 1; k < views.size(); ++k)
      if (overlap(views[i].window, views[k].window)) return true;
  return false;
}

/// Moves a view by whole millimetres, so that its coordinates stay short. Views that are in line on
/// the sheet stay so: their moves are equal but for the last digits, which must not lie where one
/// is rounded up and the other down. Round figures do not lie there.
void move_to(PlacedView& view, const PaperPoint& middle) {
  constexpr double kRoundsUpFrom = 0.63;
  const PaperPoint now = view.plane.from_paper(middle_of(view.window));
  view.plane.move(std::floor(middle.x - now.x + (1 - kRoundsUpFrom)),
                  std::floor(middle.y - now.y + (1 - kRoundsUpFrom)));
}

void arrange(std::vector<PlacedView>& views, double height_mm) {
  if (views.size() < 2) return;
  double scale = 0;
  for (const PlacedView& view : views) scale = std::max(scale, view.plane.scale());
  const bool in_a_row = any_overlap(views);
  double right = 0;
  for (PlacedView& view : views) {
    const PaperPoint on_paper = middle_of(view.window);
    PaperPoint middle{on_paper.x * scale, (height_mm - on_paper.y) * scale};
    if (in_a_row) {
      const double half = (view.window.right - view.window.left) / 2 * view.plane.scale();
      middle.x = right + half;
      right = middle.x + half + scale;
    }
    move_to(view, middle);
  }
}

std::vector<PlacedView> placed_views(const SheetFile& sheet) {
  std::vector<PlacedView> views;
  for (const SheetView& view : sheet.views) {
    if (entities_at_most(view.ink) == 0) continue;
    ModelPlane plane(view.drawing, view.ink);
    const PaperFrame window = window_of(plane);
    views.push_back({&view, std::move(plane), window});
  }
  arrange(views, sheet.height_mm);
  return views;
}

}  // namespace

Status write_sheet_file(const SheetFile& sheet, parallel::FunctionRef<void(PaperSpace&)> add_marks,
                        const model::Model& model, Sink sink, const parallel::Context& context) {
  const std::vector<PlacedView> views = placed_views(sheet);
  Document document;
  document.layers = sheet.layers;
  document.width_mm = sheet.width_mm;
  document.height_mm = sheet.height_mm;
  document.opens_on_paper = sheet.opens_on_paper;
  PaperSpace paper(sheet.width_mm, sheet.height_mm, sheet.layers, sheet.viewport_layer);
  for (const PlacedView& view : views) {
    const Extent& extent = view.plane.extent();
    document.model.include({extent.left, extent.bottom});
    document.model.include({extent.right, extent.top});
    paper.add_viewport(view.window, view.plane.from_paper(middle_of(view.window)),
                       view.plane.scale());
  }
  add_marks(paper);
  document.next = paper.next();
  for (const PlacedView& view : views) document.next += entities_at_most(view.view->ink);
  std::string text;
  append_front(text, document);
  sink(text);
  Handle first = paper.next();
  for (const PlacedView& view : views) {
    const Ink& ink = view.view->ink;
    const Status status = write_view_lines({view.view->drawing.curves, ink, view.plane}, model,
                                           sheet.layers, first, sink, context);
    if (!status) return status;
    first += entities_at_most(ink);
  }
  sink(paper.text());
  text.clear();
  append_back(text, document);
  sink(text);
  return {};
}

}  // namespace strake::drawing::dxf
