// SPDX-License-Identifier: Apache-2.0
// Layers of a DXF file: names, pens, dashes and colours.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/model/model.hpp"

namespace strake::drawing::dxf {

struct LayerStyle {
  std::string name;         ///< letters, digits, '_' and '-'
  std::string description;  ///< what a person calls it
  double width_mm = 0.25;
  std::vector<double> dash_mm = {};  ///< lengths of ink and gap by turns; empty: continuous
  model::Color color{0, 0, 0, 255};
  bool plotted = true;
};

/// The layers that lines of views lie on, later ones over earlier ones.
enum class ViewLayer : std::uint8_t {
  hidden_by_other,
  hidden_by_self,
  hatch,
  smooth,
  polyline,
  boundary,
  edge,
  intersection,
  outline,
  single_line,
  section,
  centre,
  break_line,
};
inline constexpr std::size_t kViewLayers = 13;

/// Returns the layer of a line that is visible or hidden.
[[nodiscard]] ViewLayer layer_of(const Line& line);

/// The numbers of the layers that lines of styles lie on, by style and ViewLayer; none: no line is
/// there.
using StyleLayers = std::vector<std::array<std::optional<std::size_t>, kViewLayers>>;

/// Adds the layers of the styles of objects that lines of the views have, which have one set of
/// styles, to those of all objects. Their names begin with those of the styles: "PIPING_AM_0".
[[nodiscard]] StyleLayers add_style_layers(std::span<const Ink* const> views,
                                           std::vector<LayerStyle>& layers);

/// What a layer is called, and by what name people know it.
struct LayerName {
  std::string_view name, description;
};
[[nodiscard]] LayerName name_of(ViewLayer layer);

/// Layers of what stands on paper beside views.
inline constexpr LayerName kTitleLayer{"AM_6", "Titles and captions"},
    kThinFrameLayer{"AM_BOR_THIN", "Thin lines of frame and title block"},
    kViewportLayer{"AM_VIEWS", "Frames of viewports, not plotted"};

/// Returns the layer that viewports lie on.
[[nodiscard]] LayerStyle viewport_layer();

/// Returns the layers of a drawing of one view: those of its lines in the order of ViewLayer,
/// title, thin frame and viewports.
[[nodiscard]] std::vector<LayerStyle> layers_of(const Pens& pens);
inline constexpr std::size_t kTitleOfDrawing = kViewLayers, kFrameOfDrawing = kViewLayers + 1,
                             kViewportsOfDrawing = kViewLayers + 2;

/// Returns the width that DXF has for a pen, hundredths of a millimetre.
[[nodiscard]] int line_weight(double width_mm);

/// Returns the number among the nine basic colours that is nearest to a colour. Black is number 7,
/// which programs show white on black.
[[nodiscard]] int color_number(const model::Color& color);

}  // namespace strake::drawing::dxf
