// SPDX-License-Identifier: Apache-2.0
// DXF of a drawing: its view, and the sheet round it as in SVG.
#include <array>
#include <cstddef>
#include <string>

#include "drawing/dxf/sheet_file.hpp"
#include "strake/drawing/write.hpp"

namespace strake::drawing {

namespace {

constexpr double kTitleHeightMm = 2.5;

void add_title(dxf::PaperSpace& paper, const NeutralDrawing& drawing) {
  const Sheet& sheet = drawing.sheet;
  const double right = sheet.width_mm - 10, base = sheet.height_mm - 6;
  const std::vector<PaperPoint> rule{{10, sheet.height_mm - 11}, {right, sheet.height_mm - 11}};
  paper.add_lines(dxf::kFrameOfDrawing, rule);
  paper.add_text(dxf::kTitleOfDrawing, {{10, base}, kTitleHeightMm, dxf::TextAlign::start},
                 drawing.title);
  // A view in perspective has no scale to measure by.
  if (!drawing.view.perspective)
    paper.add_text(dxf::kTitleOfDrawing, {{right, base}, kTitleHeightMm, dxf::TextAlign::end},
                   "scale " + sheet.scale_text);
}

void add_frame(dxf::PaperSpace& paper, const NeutralDrawing& drawing) {
  if (!drawing.frame) return;
  const auto& [left, top, right, bottom] = *drawing.frame;
  const std::vector<PaperPoint> frame{
      {left, top}, {right, top}, {right, bottom}, {left, bottom}, {left, top}};
  paper.add_lines(dxf::kFrameOfDrawing, frame);
}

}  // namespace

Status write_dxf(const NeutralDrawing& drawing, const Ink& ink, const model::Model& model,
                 Sink sink, const parallel::Context& context) {
  dxf::SheetFile file;
  file.sheets.push_back({.width_mm = drawing.sheet.width_mm,
                         .height_mm = drawing.sheet.height_mm,
                         .layers = dxf::layers_of(ink.pens),
                         .viewport_layer = dxf::kViewportsOfDrawing,
                         .style_layers = {},
                         .views = {{drawing, ink}}});
  const std::array<const Ink*, 1> views{&ink};
  dxf::SheetLayout& sheet = file.sheets.front();
  sheet.style_layers = dxf::add_style_layers(views, sheet.layers);
  const auto add_marks = [&](std::size_t /*sheet*/, dxf::PaperSpace& paper) {
    add_frame(paper, drawing);
    add_title(paper, drawing);
  };
  return write_sheet_file(file, add_marks, model, sink, context);
}

}  // namespace strake::drawing
