// SPDX-License-Identifier: Apache-2.0
// DXF of a sheet: its views in model space, and on paper windows that show them, with all marks.
#include <array>
#include <cstddef>
#include <span>
#include <string>

#include "drawing/dxf/layer_style.hpp"
#include "drawing/dxf/paper_space.hpp"
#include "drawing/dxf/sheet_file.hpp"
#include "sheets/output/line_styles.hpp"
#include "sheets/spec/text_metrics.hpp"
#include "strake/sheets/write.hpp"

namespace strake::sheets {

namespace {

using drawing::dxf::LayerName;
using drawing::dxf::PaperSpace;
using drawing::dxf::ViewLayer;

/// The classes that have layers of their own beside those of views, behind these in the file.
struct DxfMarkLayer {
  LineClass line;
  LayerName name;
};
constexpr std::array kDxfMarkLayers{
    DxfMarkLayer{LineClass::grid, {"AM_7", "Grid lines"}},
    DxfMarkLayer{LineClass::grid_label, {"AM_7_TEXT", "Labels of grid lines"}},
    DxfMarkLayer{LineClass::leader, {"AM_5", "Leaders of tags"}},
    DxfMarkLayer{LineClass::title, drawing::dxf::kTitleLayer},
    DxfMarkLayer{LineClass::frame, {"AM_BOR", "Frame and title block"}},
    DxfMarkLayer{LineClass::frame_thin, drawing::dxf::kThinFrameLayer},
};

LineClass class_of_view_layer(ViewLayer layer) {
  switch (layer) {
    case ViewLayer::hidden_by_other:
    case ViewLayer::hidden_by_self:
      return LineClass::hidden;
    case ViewLayer::hatch:
      return LineClass::hatch;
    case ViewLayer::smooth:
      return LineClass::smooth;
    case ViewLayer::polyline:
      return LineClass::polyline;
    case ViewLayer::boundary:
      return LineClass::boundary;
    case ViewLayer::edge:
      return LineClass::edge;
    case ViewLayer::intersection:
      return LineClass::intersection;
    case ViewLayer::outline:
      return LineClass::outline;
    case ViewLayer::section:
      return LineClass::section;
  }
  return LineClass::edge;
}

drawing::dxf::LayerStyle dxf_layer_style(const LayerName& name, const LineStyle& style) {
  return {.name = std::string(name.name),
          .description = std::string(name.description),
          .width_mm = style.width_mm,
          .dash_mm = style.dash_mm,
          .color = style.color};
}

std::vector<drawing::dxf::LayerStyle> dxf_layers_of(const LineStyles& styles) {
  std::vector<drawing::dxf::LayerStyle> layers;
  for (std::size_t i = 0; i < drawing::dxf::kViewLayers; ++i) {
    const auto layer = static_cast<ViewLayer>(i);
    layers.push_back(dxf_layer_style(drawing::dxf::name_of(layer),
                                     style_of(styles, class_of_view_layer(layer))));
  }
  for (const DxfMarkLayer& layer : kDxfMarkLayers)
    layers.push_back(dxf_layer_style(layer.name, style_of(styles, layer.line)));
  layers.push_back(drawing::dxf::viewport_layer());
  return layers;
}

/// Returns the number of the layer that marks of a class lie on.
std::size_t dxf_layer_of(LineClass line) {
  for (std::size_t i = 0; i < kDxfMarkLayers.size(); ++i)
    if (kDxfMarkLayers.at(i).line == line) return drawing::dxf::kViewLayers + i;
  for (std::size_t i = 0; i < drawing::dxf::kViewLayers; ++i)
    if (class_of_view_layer(static_cast<ViewLayer>(i)) == line) return i;
  return static_cast<std::size_t>(ViewLayer::edge);
}

drawing::dxf::TextAlign dxf_align_of(Align align) {
  return align == Align::start    ? drawing::dxf::TextAlign::start
         : align == Align::middle ? drawing::dxf::TextAlign::middle
                                  : drawing::dxf::TextAlign::end;
}

void add_dxf_marks(PaperSpace& paper, const Marks& marks) {
  for (const Text& text : marks.texts) {
    if (!text.clears) continue;
    const PaperBox box = box_of(text);
    paper.add_cover(dxf_layer_of(text.line), {box.left, box.top, box.right, box.bottom});
  }
  for (const Path& path : marks.paths) {
    if (path.filled)
      paper.add_filled(dxf_layer_of(path.line), path.points);
    else
      paper.add_lines(dxf_layer_of(path.line), path.points);
  }
  for (const Circle& circle : marks.circles)
    paper.add_circle(dxf_layer_of(circle.line), circle.center, circle.radius_mm);
  for (const Text& text : marks.texts)
    paper.add_text(dxf_layer_of(text.line), text.at, text.height_mm, dxf_align_of(text.align),
                   text.text);
}

}  // namespace

Result<Diagnostics> write_dxf(const Sheet& sheet, const model::Model& model, drawing::Sink sink,
                              const parallel::Context& context) {
  drawing::dxf::SheetFile file{.width_mm = sheet.width_mm,
                               .height_mm = sheet.height_mm,
                               .opens_on_paper = true,
                               .layers = dxf_layers_of(sheet.styles),
                               .viewport_layer = drawing::dxf::kViewLayers + kDxfMarkLayers.size(),
                               .views = {}};
  for (const PlacedView& view : sheet.views) file.views.push_back({view.drawing, view.ink});
  const auto add_all_marks = [&](PaperSpace& paper) {
    add_dxf_marks(paper, sheet.frame);
    for (const PlacedView& view : sheet.views)
      for (const Marks* marks : {&view.frame, &view.grid, &view.tags, &view.caption})
        add_dxf_marks(paper, *marks);
  };
  const Status status = write_sheet_file(file, add_all_marks, model, sink, context);
  if (!status) return status.error();
  Diagnostics noticed;
  if (sheet.artwork)
    noticed.add(Severity::warning, "template-left-out",
                "the DXF has the sheet without its template, which is SVG", "the template");
  return noticed;
}

}  // namespace strake::sheets
