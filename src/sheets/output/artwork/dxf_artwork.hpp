// SPDX-License-Identifier: Apache-2.0
// Templates of sheets as entities of a layout.
#pragma once

#include <cstddef>

#include "drawing/dxf/paper_space.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

[[nodiscard]] drawing::dxf::TextAlign dxf_align_of(Align align);

/// Adds a template to the paper, on one layer: lines, shapes and paths as polylines, curves within
/// 0.01 mm, filled shapes without what lies within them, texts. Pens and colours are those of the
/// template, each at its entity. Adds "template-part-left-out" for each kind of thing that is not
/// drawn or not as it is. Errors: input, where the elements are no XML.
[[nodiscard]] Status add_dxf_artwork(drawing::dxf::PaperSpace& paper, std::size_t layer,
                                     const Sheet& sheet, Diagnostics& diagnostics);

}  // namespace strake::sheets
