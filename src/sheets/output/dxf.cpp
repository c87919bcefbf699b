// SPDX-License-Identifier: Apache-2.0
// DXF of a sheet: its views in model space, and on paper windows that show them, with all marks.
#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/text_encoding.hpp"
#include "drawing/dxf/groups.hpp"
#include "drawing/dxf/layer_style.hpp"
#include "drawing/dxf/paper_space.hpp"
#include "drawing/dxf/sheet_file.hpp"
#include "sheets/output/artwork/dxf_artwork.hpp"
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
    DxfMarkLayer{LineClass::grid, {"AM_7_GRID", "Grid lines"}},
    DxfMarkLayer{LineClass::grid_label, {"AM_7_TEXT", "Labels of grid lines"}},
    DxfMarkLayer{LineClass::dimension, {"AM_5", "Dimensions"}},
    DxfMarkLayer{LineClass::leader, {"AM_5_TAG", "Tags and their leaders"}},
    DxfMarkLayer{LineClass::note, {"AM_5_NOTE", "Levels, scale bar, north, lists"}},
    DxfMarkLayer{LineClass::cutting_plane, {"AM_10", "Where other views are cut"}},
    DxfMarkLayer{LineClass::extent, {"AM_11", "What other views show"}},
    DxfMarkLayer{LineClass::match_line, {"AM_11_MATCH", "Match lines"}},
    DxfMarkLayer{LineClass::title, drawing::dxf::kTitleLayer},
    DxfMarkLayer{LineClass::frame, {"AM_BOR", "Frame and title block"}},
    DxfMarkLayer{LineClass::frame_thin, drawing::dxf::kThinFrameLayer},
};

LineClass class_of_view_layer(ViewLayer layer, bool split_hidden) {
  switch (layer) {
    case ViewLayer::hidden_by_other:
      return split_hidden ? LineClass::hidden_other : LineClass::hidden;
    case ViewLayer::hidden_by_self:
      return split_hidden ? LineClass::hidden_self : LineClass::hidden;
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
    case ViewLayer::centre:
      return LineClass::centre;
    case ViewLayer::single_line:
      return LineClass::single_line;
    case ViewLayer::break_line:
      return LineClass::break_line;
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

std::vector<drawing::dxf::LayerStyle> dxf_layers_of(const Sheet& sheet) {
  const bool split_hidden = std::ranges::any_of(
      sheet.views, [](const PlacedView& view) { return view.ink.split_hidden; });
  std::vector<drawing::dxf::LayerStyle> layers;
  for (std::size_t i = 0; i < drawing::dxf::kViewLayers; ++i) {
    const auto layer = static_cast<ViewLayer>(i);
    layers.push_back(
        dxf_layer_style(drawing::dxf::name_of(layer),
                        style_of(sheet.styles, class_of_view_layer(layer, split_hidden))));
  }
  for (const DxfMarkLayer& layer : kDxfMarkLayers)
    layers.push_back(dxf_layer_style(layer.name, style_of(sheet.styles, layer.line)));
  layers.push_back(drawing::dxf::viewport_layer());
  return layers;
}

/// Returns the layer of views that lines of a class lie on; none: marks have one of their own.
constexpr std::optional<ViewLayer> view_layer_of(LineClass line) {
  switch (line) {
    case LineClass::outline:
      return ViewLayer::outline;
    case LineClass::single_line:
      return ViewLayer::single_line;
    case LineClass::edge:
      return ViewLayer::edge;
    case LineClass::boundary:
      return ViewLayer::boundary;
    case LineClass::intersection:
      return ViewLayer::intersection;
    case LineClass::section:
      return ViewLayer::section;
    case LineClass::hatch:
      return ViewLayer::hatch;
    case LineClass::polyline:
      return ViewLayer::polyline;
    case LineClass::smooth:
      return ViewLayer::smooth;
    case LineClass::hidden:
    case LineClass::hidden_other:
      return ViewLayer::hidden_by_other;
    case LineClass::hidden_self:
      return ViewLayer::hidden_by_self;
    case LineClass::centre:
      return ViewLayer::centre;
    case LineClass::break_line:
      return ViewLayer::break_line;
    case LineClass::grid:
    case LineClass::grid_label:
    case LineClass::leader:
    case LineClass::title:
    case LineClass::frame:
    case LineClass::frame_thin:
    case LineClass::cutting_plane:
    case LineClass::extent:
    case LineClass::match_line:
    case LineClass::note:
    case LineClass::dimension:
      break;
  }
  return std::nullopt;
}

/// Returns the number of the layer that marks of a class lie on.
constexpr std::size_t dxf_layer_of(LineClass line) {
  if (const auto layer = view_layer_of(line)) return static_cast<std::size_t>(*layer);
  std::size_t i = 0;
  while (kDxfMarkLayers.at(i).line != line) ++i;
  return drawing::dxf::kViewLayers + i;
}

// Each class has a layer: one without would reach beyond the list here.
static_assert([] {
  for (std::size_t c = 0; c < kLineClasses; ++c) (void)dxf_layer_of(static_cast<LineClass>(c));
  return true;
}());

void add_dxf_marks(PaperSpace& paper, const Marks& marks) {
  for (const Text& text : marks.texts) {
    if (!text.clears) continue;
    const std::array<PaperPoint, 4> corners = corners_of(text);
    paper.add_cover(dxf_layer_of(text.line), {corners[0], corners[1], corners[3]});
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
    paper.add_text(dxf_layer_of(text.line),
                   {text.at, text.height_mm, dxf_align_of(text.align), text.turn_deg}, text.text);
}

/// Gives layers of a sheet that look otherwise than those of their names before it the number of
/// the sheet behind their names.
void make_names_unique(std::vector<drawing::dxf::LayerStyle>& layers, std::size_t sheet,
                       std::map<std::string, drawing::dxf::LayerStyle>& known) {
  for (drawing::dxf::LayerStyle& layer : layers) {
    const auto& first = known.emplace(layer.name, layer).first->second;
    if (first.width_mm == layer.width_mm && first.dash_mm == layer.dash_mm &&
        first.color == layer.color)
      continue;
    layer.name += "-" + std::to_string(sheet + 1);
  }
}

/// Names layouts by their sheets.
class LayoutNames {
 public:
  explicit LayoutNames(std::size_t sheets) : several_(sheets > 1) {}

  /// Returns the name of the next layout; programs take upper and lower case for the same.
  std::string next(const Sheet& sheet) {
    ++number_;
    if (!several_ && sheet.name.empty()) return "Sheet";
    std::string name = fit_for_layout(sheet.name.empty() ? sheet.title : sheet.name);
    if (name.empty() || lowered(name) == "model") name = "Sheet " + std::to_string(number_);
    std::string unique = name;
    for (int n = 2; !taken_.insert(lowered(unique)).second; ++n)
      unique = name + " (" + std::to_string(n) + ")";
    return unique;
  }

 private:
  static std::string fit_for_layout(std::string_view name) {
    constexpr std::size_t kMaxBytes = 200;
    std::string fit = drawing::dxf::value_text(name, kMaxBytes);
    for (char& c : fit)
      if (std::string_view("<>/\\\":;?*|,=`").find(c) != std::string_view::npos) c = '_';
    return fit;
  }

  bool several_;
  std::size_t number_ = 0;
  std::set<std::string> taken_;
};

}  // namespace

Result<Diagnostics> write_dxf(std::span<const Sheet> sheets, const model::Model& model,
                              drawing::Sink sink, const parallel::Context& context) {
  if (sheets.empty()) return Error{ErrorCode::usage, "there is no sheet to write", {}, {}};
  drawing::dxf::SheetFile file{.opens_on_paper = true, .sheets = {}};
  std::map<std::string, drawing::dxf::LayerStyle> known;
  LayoutNames names(sheets.size());
  for (const Sheet& sheet : sheets) {
    drawing::dxf::SheetLayout layout{
        .name = names.next(sheet),
        .width_mm = sheet.width_mm,
        .height_mm = sheet.height_mm,
        .layers = dxf_layers_of(sheet),
        .viewport_layer = drawing::dxf::kViewLayers + kDxfMarkLayers.size(),
        .style_layers = {},
        .views = {}};
    std::vector<const drawing::Ink*> inks;
    for (const PlacedView& view : sheet.views) inks.push_back(&view.ink);
    layout.style_layers = drawing::dxf::add_style_layers(inks, layout.layers);
    make_names_unique(layout.layers, file.sheets.size(), known);
    for (const PlacedView& view : sheet.views) layout.views.push_back({view.drawing, view.ink});
    file.sheets.push_back(std::move(layout));
  }
  Diagnostics noticed;
  Status drawn;
  const auto add_all_marks = [&](std::size_t number, PaperSpace& paper) {
    const Sheet& sheet = sheets[number];
    if (sheet.artwork && drawn)
      drawn = add_dxf_artwork(paper, dxf_layer_of(LineClass::frame), sheet, noticed);
    add_dxf_marks(paper, sheet.frame);
    add_dxf_marks(paper, sheet.notes);
    for (const PlacedView& view : sheet.views)
      for (const Marks* marks :
           {&view.frame, &view.grid, &view.notes, &view.match_lines, &view.tags, &view.caption})
        add_dxf_marks(paper, *marks);
  };
  const Status status = write_sheet_file(file, add_all_marks, model, sink, context);
  if (!status) return status.error();
  if (!drawn) return drawn.error();
  return noticed;
}

}  // namespace strake::sheets
