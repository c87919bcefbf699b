// SPDX-License-Identifier: Apache-2.0
// The styles of objects in the style sheet of an SVG.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "drawing/strokes/layer_pens.hpp"
#include "strake/drawing/ink.hpp"

namespace strake::drawing {

/// Returns the rules for the lines of each style in each layer of the views, which have one set of
/// styles, and for break lines, which have the pen `break_lines` without a style. `scope` stands
/// before each selector: ".strake ".
[[nodiscard]] std::string svg_style_rules(std::span<const Ink* const> views, std::string_view scope,
                                          PenOfLayer pen_of, const LinePen& break_lines);

}  // namespace strake::drawing
