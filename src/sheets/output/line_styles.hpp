// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "sheets/spec/sheet_spec.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// Returns the styles of a sheet: those of ISO 128 for these pens, overridden by the file.
[[nodiscard]] LineStyles styles_of(const std::array<StyleSpec, kLineClasses>& specs,
                                   const drawing::Pens& pens);

/// Returns the widths that the lines of views have in these styles.
[[nodiscard]] drawing::Pens pens_of(const LineStyles& styles);

[[nodiscard]] inline const LineStyle& style_of(const LineStyles& styles, LineClass line) {
  return styles[static_cast<std::size_t>(line)];
}

}  // namespace strake::sheets
