// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "drawing/strokes/layer_pens.hpp"
#include "sheets/spec/sheet_spec.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// Returns the styles of a sheet: those of ISO 128 for these pens, overridden by the file.
[[nodiscard]] LineStyles styles_of(const std::array<StyleSpec, kLineClasses>& specs,
                                   const drawing::Pens& pens);

/// Returns the class of a hidden line: that of all, or where the ink keeps apart what hides them,
/// one of two.
[[nodiscard]] inline LineClass hidden_class(const drawing::Ink& ink, drawing::LineState state) {
  if (!ink.split_hidden) return LineClass::hidden;
  return state == drawing::LineState::hidden_by_self ? LineClass::hidden_self
                                                     : LineClass::hidden_other;
}

/// Returns the widths that the lines of views have in these styles.
[[nodiscard]] drawing::Pens pens_of(const LineStyles& styles);

/// Returns the pen of a layer of a view in these styles.
[[nodiscard]] drawing::LinePen pen_of_layer(const LineStyles& styles, const drawing::Ink& ink,
                                            const drawing::Layer& layer, drawing::LineState state);

[[nodiscard]] inline const LineStyle& style_of(const LineStyles& styles, LineClass line) {
  return styles[static_cast<std::size_t>(line)];
}

}  // namespace strake::sheets
