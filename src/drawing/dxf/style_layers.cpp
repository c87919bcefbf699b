// SPDX-License-Identifier: Apache-2.0
// The layers of the styles of objects.
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "drawing/dxf/groups.hpp"
#include "drawing/dxf/layer_style.hpp"
#include "drawing/strokes/layer_pens.hpp"

namespace strake::drawing::dxf {

namespace {

/// Returns what of a name may stand in that of a layer.
std::string fit_for_layer(std::string_view name) {
  constexpr std::size_t kMaxBytes = 100;
  std::string fit = value_text(name, kMaxBytes);
  // Programs take upper and lower case for the same.
  for (char& c : fit) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    if (std::string_view("<>/\\\":;?*|,=`' ^").find(c) != std::string_view::npos) c = '_';
  }
  return fit;
}

/// Returns a layer of which styles make what they make of this one.
Layer as_layer(ViewLayer layer) {
  const bool hidden = layer == ViewLayer::hidden_by_other || layer == ViewLayer::hidden_by_self;
  // Break lines are continuous, as hatches are.
  const bool continuous = layer == ViewLayer::hatch || layer == ViewLayer::break_line;
  return {hidden, continuous ? hlr::EdgeKind::hatch : hlr::EdgeKind::sharp, {}};
}

LayerStyle styled_layer(const LayerStyle& usual, ViewLayer layer, const Ink& ink,
                        std::size_t number) {
  const LinePen pen = styled_pen({usual.width_mm, usual.dash_mm, usual.color}, as_layer(layer),
                                 *ink.styles, number, ink.pens.edge);
  const std::string label = style_label(*ink.styles, number);
  return {.name = fit_for_layer(label) + "_" + usual.name,
          .description = usual.description + ", " + value_text(label, kMaxOfData / 2),
          .width_mm = pen.width_mm,
          .dash_mm = pen.dash_mm,
          .color = pen.color,
          .plotted = usual.plotted};
}

}  // namespace

StyleLayers add_style_layers(std::span<const Ink* const> views, std::vector<LayerStyle>& layers) {
  StyleLayers found;
  if (views.empty() || views.front()->styles == nullptr) return found;
  const Ink& first = *views.front();
  std::vector<std::array<bool, kViewLayers>> used(first.styles->all().size() + 1);
  for (const Ink* const ink : views) {
    for (const Line& line : ink->in_model_space())
      used[ink->styles->number_of(line)].at(static_cast<std::size_t>(layer_of(line))) = true;
    for (const BreakLine& line : ink->break_lines)
      used[ink->styles->number_of(line.object)].at(
          static_cast<std::size_t>(ViewLayer::break_line)) = true;
  }
  std::set<std::string> names;
  for (const LayerStyle& layer : layers) names.insert(layer.name);
  found.resize(first.styles->all().size());
  for (std::size_t s = 0; s < found.size(); ++s)
    for (std::size_t l = 0; l < kViewLayers; ++l) {
      if (!used[s + 1].at(l)) continue;
      LayerStyle layer = styled_layer(layers[l], static_cast<ViewLayer>(l), first, s + 1);
      if (!names.insert(layer.name).second) {
        layer.name += "_" + std::to_string(s + 1);
        names.insert(layer.name);
      }
      found[s].at(l) = layers.size();
      layers.push_back(std::move(layer));
    }
  return found;
}

}  // namespace strake::drawing::dxf
