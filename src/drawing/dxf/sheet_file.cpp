// SPDX-License-Identifier: Apache-2.0
#include "drawing/dxf/sheet_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

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

/// Places the views of a sheet whose paper begins at `left` in model space, mm. Returns where the
/// next sheet may begin.
double arrange(std::vector<PlacedView>& views, const SheetLayout& sheet, double left) {
  double scale = 0;
  for (const PlacedView& view : views) scale = std::max(scale, view.plane.scale());
  const bool in_a_row = any_overlap(views);
  double right = left;
  for (PlacedView& view : views) {
    const PaperPoint on_paper = middle_of(view.window);
    PaperPoint middle{left + on_paper.x * scale, (sheet.height_mm - on_paper.y) * scale};
    if (in_a_row) {
      const double half = (view.window.right - view.window.left) / 2 * view.plane.scale();
      middle.x = right + half;
      right = middle.x + half + scale;
    }
    move_to(view, middle);
  }
  // A tenth of the sheet lies between it and the next.
  constexpr double kWithGap = 1.1;
  return std::ceil(std::max(right, left + kWithGap * sheet.width_mm * scale));
}

using ViewsOfSheets = std::vector<std::vector<PlacedView>>;

ViewsOfSheets placed_views(const SheetFile& file) {
  ViewsOfSheets placed;
  std::size_t count = 0;
  for (const SheetLayout& sheet : file.sheets) {
    std::vector<PlacedView> views;
    for (const SheetView& view : sheet.views) {
      if (entities_at_most(view.ink) == 0) continue;
      ModelPlane plane(view.drawing, view.ink);
      const PaperFrame window = window_of(plane);
      views.push_back({&view, std::move(plane), window});
    }
    count += views.size();
    placed.push_back(std::move(views));
  }
  if (count < 2) return placed;
  double left = 0;
  for (std::size_t s = 0; s < placed.size(); ++s) left = arrange(placed[s], file.sheets[s], left);
  return placed;
}

/// Returns the layers of all sheets, those with one name once.
std::vector<LayerStyle> layers_of_sheets(const SheetFile& file) {
  std::vector<LayerStyle> layers;
  std::set<std::string> names;
  for (const SheetLayout& sheet : file.sheets)
    for (const LayerStyle& layer : sheet.layers)
      if (names.insert(layer.name).second) layers.push_back(layer);
  return layers;
}

}  // namespace

Status write_sheet_file(const SheetFile& file, AddMarks add_marks, const model::Model& model,
                        Sink sink, const parallel::Context& context) {
  const ViewsOfSheets placed = placed_views(file);
  DxfDocument document;
  document.layers = layers_of_sheets(file);
  document.opens_on_paper = file.opens_on_paper;
  document.next = first_entity(document.layers.size());
  std::vector<PaperSpace> papers;
  for (std::size_t s = 0; s < placed.size(); ++s) {
    const SheetLayout& sheet = file.sheets[s];
    PaperLayout layout{
        .name = sheet.name, .width_mm = sheet.width_mm, .height_mm = sheet.height_mm};
    if (s > 0)
      for (Handle* const handle : {&layout.record, &layout.begin, &layout.end, &layout.layout})
        *handle = document.next++;
    layout.paper = document.next;
    PaperSpace paper({sheet.width_mm, sheet.height_mm}, sheet.layers, sheet.viewport_layer,
                     layout.record, layout.paper);
    for (const PlacedView& view : placed[s]) {
      const DxfExtent& extent = view.plane.extent();
      document.model.include({extent.left, extent.bottom});
      document.model.include({extent.right, extent.top});
      paper.add_viewport(view.window, view.plane.from_paper(middle_of(view.window)),
                         view.plane.scale());
    }
    add_marks(s, paper);
    document.next = paper.next();
    document.papers.push_back(std::move(layout));
    papers.push_back(std::move(paper));
  }
  for (std::size_t s = 1; s < papers.size(); ++s) document.papers[s].entities = papers[s].text();
  Handle first = document.next;
  for (const std::vector<PlacedView>& views : placed)
    for (const PlacedView& view : views) document.next += entities_at_most(view.view->ink);
  std::string text;
  append_dxf_head(text, document);
  sink(text);
  for (std::size_t s = 0; s < placed.size(); ++s)
    for (const PlacedView& view : placed[s]) {
      const Ink& ink = view.view->ink;
      const SheetLayout& sheet = file.sheets[s];
      const Status status =
          write_view_lines({view.view->drawing.curves, ink, view.plane, sheet.style_layers}, model,
                           sheet.layers, first, sink, context);
      if (!status) return status;
      first += entities_at_most(ink);
    }
  sink(papers.front().text());
  text.clear();
  append_dxf_tail(text, document);
  sink(text);
  return {};
}

}  // namespace strake::drawing::dxf
