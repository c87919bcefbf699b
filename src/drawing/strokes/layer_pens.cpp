// SPDX-License-Identifier: Apache-2.0
#include "drawing/strokes/layer_pens.hpp"

#include <cmath>
#include <utility>

#include "drawing/ink/dash_fit.hpp"
#include "drawing/ink/hidden_ink.hpp"

namespace strake::drawing {

namespace {

/// Rounds to tenths of a micrometre of paper, which keeps numbers short.
double in_whole_steps(double mm) { return std::round(mm * 1e4) / 1e4; }

template <class L, class NumberOf>
std::vector<StyledLines<L>> parted_by_style(std::vector<const L*> lines, const Ink& ink,
                                            const NumberOf& number_of) {
  std::vector<StyledLines<L>> parts;
  if (ink.styles == nullptr) {
    if (!lines.empty()) parts.push_back({ObjectStyles::kPlain, std::move(lines)});
    return parts;
  }
  std::vector<std::vector<const L*>> of(ink.styles->all().size() + 1);
  for (const L* const line : lines) of[number_of(*line)].push_back(line);
  for (std::size_t style = 0; style < of.size(); ++style)
    if (!of[style].empty()) parts.push_back({style, std::move(of[style])});
  return parts;
}

}  // namespace

LinePen usual_pen(const Layer& layer, const Pens& pens) {
  const bool polyline = layer.kind == hlr::EdgeKind::polyline;
  LinePen pen{pens.thin, {}, {0, 0, 0, 255}};
  if (layer.hidden) {
    pen.dash_mm = pen_dashes(kHiddenDashes, pens.thin);
    pen.color =
        polyline ? model::Color{0x66, 0x88, 0xAA, 255} : model::Color{0x44, 0x44, 0x44, 255};
  } else if (layer.kind == hlr::EdgeKind::contour || layer.kind == hlr::EdgeKind::single_line) {
    pen.width_mm = pens.outline;
  } else if (layer.kind == hlr::EdgeKind::section) {
    pen.width_mm = pens.section;
  } else if (polyline) {
    pen.color = {0x22, 0x44, 0x66, 255};
  } else if (layer.kind != hlr::EdgeKind::hatch && layer.kind != hlr::EdgeKind::smooth) {
    pen.width_mm = pens.edge;
  }
  return pen;
}

LinePen styled_pen(LinePen usual, const Layer& layer, const ObjectStyles& styles,
                   std::size_t number, double edge_mm) {
  if (number == ObjectStyles::kPlain) return usual;
  const ObjectStyle& style = styles.all()[number - 1];
  const double wider = styles.widening(number, edge_mm);
  usual.width_mm = in_whole_steps(usual.width_mm * wider);
  if (style.color) usual.color = *style.color;
  if (!layer.hidden && layer.kind != hlr::EdgeKind::hatch && style.line) {
    usual.dash_mm = style.line->dashes;
    if (style.line->in_widths)
      for (double& dash : usual.dash_mm) dash = in_whole_steps(dash * usual.width_mm);
  } else {
    // Dashes are as long as the pen requests.
    for (double& dash : usual.dash_mm) dash = in_whole_steps(dash * wider);
  }
  return usual;
}

LinePen styled_break_pen(LinePen usual, const ObjectStyles& styles, std::size_t number,
                         double edge_mm) {
  // Hatches are continuous, too, whatever the style says.
  return styled_pen(std::move(usual), {false, hlr::EdgeKind::hatch, {}}, styles, number, edge_mm);
}

std::vector<LinesOfStyle> by_style(std::span<const Line* const> lines, const Ink& ink) {
  return parted_by_style<Line>({lines.begin(), lines.end()}, ink,
                               [&](const Line& line) { return ink.styles->number_of(line); });
}

std::vector<BreakLinesOfStyle> break_lines_by_style(const Ink& ink) {
  std::vector<const BreakLine*> lines;
  for (const BreakLine& line : ink.break_lines) lines.push_back(&line);
  return parted_by_style<BreakLine>(std::move(lines), ink, [&](const BreakLine& line) {
    return ink.styles->number_of(line.object);
  });
}

std::string style_label(const ObjectStyles& styles, std::size_t number) {
  const std::string& name = styles.all()[number - 1].name;
  return name.empty() ? "style " + std::to_string(number) : name;
}

}  // namespace strake::drawing
