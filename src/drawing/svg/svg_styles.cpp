// SPDX-License-Identifier: Apache-2.0
#include "drawing/svg/svg_styles.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <vector>

#include "core/number.hpp"
#include "drawing/layout/duplicates.hpp"
#include "model/attributes.hpp"

namespace strake::drawing {

namespace {

/// What of a layer has a rule of its own for a style.
struct RulePlace {
  LineState state;
  std::string_view within;  ///< a class between that of the layer and that of the style
};

std::string rule_of(const std::string& selector, const LinePen& pen) {
  return fmt::format("{} {{ stroke: {}; stroke-width: {};{} }}\n", selector,
                     model::color_text(pen.color), shortest(pen.width_mm),
                     pen.dash_mm.empty() ? " stroke-dasharray: none;" : " stroke-linecap: butt;");
}

/// Returns which styles have lines in a layer: those that are hidden in one way, or all.
std::vector<bool> styles_in(const Layer& layer, std::span<const Ink* const> views,
                            const RulePlace& place, std::size_t styles) {
  std::vector<bool> found(styles + 1);
  for (const Ink* const ink : views)
    for (const Line& line : ink->lines)
      if (belongs(line, layer) && (place.within.empty() || line.state == place.state))
        found[ink->styles->number_of(line)] = true;
  return found;
}

}  // namespace

std::string svg_style_rules(std::span<const Ink* const> views, std::string_view scope,
                            PenOfLayer pen_of, const LinePen& break_lines) {
  std::string rules;
  if (views.empty() || views.front()->styles == nullptr) return rules;
  const ObjectStyles& styles = *views.front()->styles;
  const bool split = views.front()->split_hidden;
  for (const Layer& layer : kLayers) {
    std::vector<RulePlace> places{
        {layer.hidden ? LineState::hidden_by_self : LineState::visible, {}}};
    if (layer.hidden && split)
      places = {{LineState::hidden_by_other, ".by-other "},
                {LineState::hidden_by_self, ".by-self "}};
    for (const RulePlace& place : places) {
      const std::vector<bool> used = styles_in(layer, views, place, styles.all().size());
      for (std::size_t number = 1; number < used.size(); ++number)
        if (used[number])
          rules += rule_of(
              fmt::format("{}.{}.{} {}.style-{} path", scope, layer.hidden ? "hidden" : "visible",
                          kind_name(layer.kind), place.within, number),
              styled_pen(pen_of(layer, place.state), layer, styles, number,
                         views.front()->pens.edge));
    }
  }
  std::vector<bool> broken(styles.all().size() + 1);
  for (const Ink* const ink : views)
    for (const BreakLine& line : ink->break_lines) broken[styles.number_of(line.object)] = true;
  for (std::size_t number = 1; number < broken.size(); ++number)
    if (broken[number])
      rules += rule_of(fmt::format("{}.break .style-{} path", scope, number),
                       styled_break_pen(break_lines, styles, number, views.front()->pens.edge));
  return rules;
}

}  // namespace strake::drawing
