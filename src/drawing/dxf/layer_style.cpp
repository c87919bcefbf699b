// SPDX-License-Identifier: Apache-2.0
#include "drawing/dxf/layer_style.hpp"

#include <algorithm>
#include <cmath>

#include "drawing/ink/dash_fit.hpp"
#include "drawing/ink/hidden_ink.hpp"
#include "drawing/layout/duplicates.hpp"

namespace strake::drawing::dxf {

namespace {

constexpr std::array<LayerName, kViewLayers> kNames{{
    {"AM_3", "Hidden by other objects"},
    {"AM_3_SELF", "Hidden by the object itself"},
    {"AM_8", "Hatches of sections"},
    {"AM_4_SMOOTH", "Smooth edges"},
    {"AM_4", "Polylines"},
    {"AM_0_BOUNDARY", "Open edges"},
    {"AM_0_EDGE", "Visible edges"},
    {"AM_0_INTERSECTION", "Intersections of bodies"},
    {"AM_0", "Visible outlines"},
    {"AM_0_PIPE", "Single-line pipes"},
    {"AM_0_SECTION", "Outlines of sections"},
    {"AM_7", "Centre lines"},
    {"AM_4_BREAK", "Break lines"},
}};

LayerStyle style_of_view(ViewLayer layer, const Pens& pens) {
  LayerStyle style{std::string(name_of(layer).name), std::string(name_of(layer).description)};
  switch (layer) {
    case ViewLayer::hidden_by_other:
    case ViewLayer::hidden_by_self:
      style.width_mm = pens.thin;
      style.dash_mm = pen_dashes(kHiddenDashes, pens.thin);
      style.color = {0x44, 0x44, 0x44, 255};
      break;
    case ViewLayer::polyline:
      style.width_mm = pens.thin;
      style.color = {0x22, 0x44, 0x66, 255};
      break;
    case ViewLayer::hatch:
    case ViewLayer::smooth:
    case ViewLayer::break_line:
      style.width_mm = pens.thin;
      break;
    case ViewLayer::boundary:
    case ViewLayer::edge:
    case ViewLayer::intersection:
      style.width_mm = pens.edge;
      break;
    case ViewLayer::outline:
    case ViewLayer::single_line:
      style.width_mm = pens.outline;
      break;
    case ViewLayer::section:
      style.width_mm = pens.section;
      break;
    case ViewLayer::centre:
      style.width_mm = pens.thin;
      style.dash_mm = pen_dashes(kCentreDashes, pens.thin);
      break;
  }
  return style;
}

}  // namespace

ViewLayer layer_of(const Line& line) {
  if (line.state == LineState::hidden_by_self) return ViewLayer::hidden_by_self;
  if (is_hidden(line.state)) return ViewLayer::hidden_by_other;
  switch (line.kind) {
    case hlr::EdgeKind::contour:
      return ViewLayer::outline;
    case hlr::EdgeKind::single_line:
      return ViewLayer::single_line;
    case hlr::EdgeKind::boundary:
      return ViewLayer::boundary;
    case hlr::EdgeKind::intersection:
      return ViewLayer::intersection;
    case hlr::EdgeKind::section:
      return ViewLayer::section;
    case hlr::EdgeKind::hatch:
      return ViewLayer::hatch;
    case hlr::EdgeKind::polyline:
      return ViewLayer::polyline;
    case hlr::EdgeKind::smooth:
      return ViewLayer::smooth;
    case hlr::EdgeKind::sharp:
    case hlr::EdgeKind::non_manifold:
      break;
  }
  return ViewLayer::edge;
}

LayerName name_of(ViewLayer layer) { return kNames.at(static_cast<std::size_t>(layer)); }

LayerStyle viewport_layer() {
  return {.name = std::string(kViewportLayer.name),
          .description = std::string(kViewportLayer.description),
          .width_mm = 0.13,
          .color = {128, 128, 128, 255},
          .plotted = false};
}

std::vector<LayerStyle> layers_of(const Pens& pens) {
  std::vector<LayerStyle> layers;
  for (std::size_t layer = 0; layer < kViewLayers; ++layer)
    layers.push_back(style_of_view(static_cast<ViewLayer>(layer), pens));
  for (const LayerName& name : {kTitleLayer, kThinFrameLayer})
    layers.push_back({std::string(name.name), std::string(name.description), pens.thin});
  layers.push_back(viewport_layer());
  return layers;
}

int line_weight(double width_mm) {
  constexpr std::array kWeights{0,  5,  9,  13, 15, 18,  20,  25,  30,  35,  40,  50,
                                53, 60, 70, 80, 90, 100, 106, 120, 140, 158, 200, 211};
  const double width = width_mm * 100;
  return *std::ranges::min_element(
      kWeights, {}, [&](int weight) { return std::fabs(static_cast<double>(weight) - width); });
}

int color_number(const model::Color& color) {
  struct BasicColor {
    int number = 0;
    model::Color color;
  };
  constexpr std::array kBasic{
      BasicColor{7, {0, 0, 0, 255}},       BasicColor{1, {255, 0, 0, 255}},
      BasicColor{2, {255, 255, 0, 255}},   BasicColor{3, {0, 255, 0, 255}},
      BasicColor{4, {0, 255, 255, 255}},   BasicColor{5, {0, 0, 255, 255}},
      BasicColor{6, {255, 0, 255, 255}},   BasicColor{8, {128, 128, 128, 255}},
      BasicColor{9, {192, 192, 192, 255}}, BasicColor{255, {255, 255, 255, 255}}};
  const auto apart = [&](const BasicColor& basic) {
    const int r = basic.color.red - color.red, g = basic.color.green - color.green,
              b = basic.color.blue - color.blue;
    return r * r + g * g + b * b;
  };
  return std::ranges::min_element(kBasic, {}, apart)->number;
}

}  // namespace strake::drawing::dxf
