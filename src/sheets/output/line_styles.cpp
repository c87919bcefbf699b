// SPDX-License-Identifier: Apache-2.0
#include "sheets/output/line_styles.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "drawing/ink/dash_fit.hpp"
#include "drawing/ink/hidden_ink.hpp"

namespace strake::sheets {

namespace {

/// Returns the dashes of a class in widths of its pen, ISO 128-2 types 02 and 04. A dot is as long
/// as it is wide, or else it is not seen in print.
std::vector<double> usual_dashes(LineClass line, double width) {
  if (line == LineClass::hidden) return drawing::pen_dashes(drawing::kHiddenDashes, width);
  if (line == LineClass::grid || line == LineClass::centre || line == LineClass::cutting_plane)
    return drawing::pen_dashes(drawing::kCentreDashes, width);
  // Long dash and two dots, type 05.
  if (line == LineClass::extent || line == LineClass::match_line)
    return drawing::pen_dashes(std::array{24.0, 3.0, 1.0, 3.0, 1.0, 3.0}, width);
  return {};
}

double usual_width(LineClass line, const drawing::Pens& pens) {
  switch (line) {
    case LineClass::outline:
    case LineClass::single_line:
    case LineClass::match_line:
      return pens.outline;
    case LineClass::edge:
    case LineClass::boundary:
    case LineClass::intersection:
      return pens.edge;
    case LineClass::section:
      return pens.section;
    case LineClass::hatch:
    case LineClass::polyline:
    case LineClass::smooth:
    case LineClass::hidden:
    case LineClass::hidden_self:
    case LineClass::hidden_other:
      return pens.thin;
    case LineClass::grid:
    case LineClass::centre:
    case LineClass::cutting_plane:
    case LineClass::extent:
    case LineClass::note:
    case LineClass::dimension:
    case LineClass::grid_label:
    case LineClass::leader:
    case LineClass::break_line:
      // As thin as hidden lines, and no thinner than prints well.
      return std::max(pens.thin, 0.13);
    case LineClass::title:
      return 0.35;
    case LineClass::frame:
      return 0.7;
    case LineClass::frame_thin:
      return 0.25;
  }
  return pens.thin;
}

}  // namespace

std::string_view class_name(LineClass line) {
  constexpr std::array<std::string_view, kLineClasses> kNames{
      "outline",     "edge",         "boundary",    "intersection",  "section",
      "hatch",       "polyline",     "smooth",      "hidden",        "grid",
      "grid_label",  "leader",       "title",       "frame",         "frame_thin",
      "hidden_self", "hidden_other", "centre",      "cutting_plane", "extent",
      "note",        "dimension",    "single_line", "break_line",    "match_line"};
  return kNames.at(static_cast<std::size_t>(line));
}

LineClass class_of(hlr::EdgeKind kind, bool hidden) {
  if (hidden) return LineClass::hidden;
  switch (kind) {
    case hlr::EdgeKind::contour:
      return LineClass::outline;
    case hlr::EdgeKind::boundary:
      return LineClass::boundary;
    case hlr::EdgeKind::intersection:
      return LineClass::intersection;
    case hlr::EdgeKind::section:
      return LineClass::section;
    case hlr::EdgeKind::hatch:
      return LineClass::hatch;
    case hlr::EdgeKind::polyline:
      return LineClass::polyline;
    case hlr::EdgeKind::smooth:
      return LineClass::smooth;
    case hlr::EdgeKind::single_line:
      return LineClass::single_line;
    case hlr::EdgeKind::sharp:
    case hlr::EdgeKind::non_manifold:
      break;
  }
  return LineClass::edge;
}

namespace {

std::size_t index_of(LineClass line) { return static_cast<std::size_t>(line); }

/// Returns a style as the file has it, with what is usual in the place of what it does not say.
template <class UsualDashes>
LineStyle styled(const StyleSpec& spec, const model::Color& color, double width_mm,
                 const UsualDashes& usual) {
  LineStyle style;
  style.width_mm = spec.width_mm.value_or(width_mm);
  style.dash_mm = spec.dash_mm ? *spec.dash_mm : usual(style.width_mm);
  style.color = spec.color.value_or(color);
  return style;
}

}  // namespace

LineStyles styles_of(const std::array<StyleSpec, kLineClasses>& specs, const drawing::Pens& pens) {
  LineStyles styles;
  for (std::size_t c = 0; c < kLineClasses; ++c) {
    const auto line = static_cast<LineClass>(c);
    styles[c] = styled(specs[c], styles[c].color, usual_width(line, pens),
                       [&](double width) { return usual_dashes(line, width); });
  }
  // What is hidden in either way is drawn as all hidden lines unless the file says otherwise.
  const StyleSpec& hidden = specs[index_of(LineClass::hidden)];
  const LineStyle& base = styles[index_of(LineClass::hidden)];
  for (const LineClass line : {LineClass::hidden_self, LineClass::hidden_other})
    styles[index_of(line)] =
        styled(specs[index_of(line)], base.color, base.width_mm, [&](double width) {
          return hidden.dash_mm ? *hidden.dash_mm : usual_dashes(LineClass::hidden, width);
        });
  return styles;
}

drawing::LinePen pen_of_layer(const LineStyles& styles, const drawing::Ink& ink,
                              const drawing::Layer& layer, drawing::LineState state) {
  const LineStyle& style = style_of(
      styles, layer.hidden ? hidden_class(ink, state) : class_of(layer.kind, layer.hidden));
  return {style.width_mm, style.dash_mm, style.color};
}

drawing::Pens pens_of(const LineStyles& styles) {
  return {.outline = style_of(styles, LineClass::outline).width_mm,
          .edge = style_of(styles, LineClass::edge).width_mm,
          .thin = style_of(styles, LineClass::hidden).width_mm,
          .section = style_of(styles, LineClass::section).width_mm};
}

}  // namespace strake::sheets
