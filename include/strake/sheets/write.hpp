// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/drawing/write.hpp"
#include "strake/model/model.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// A sheet as SVG in millimetres of paper: a group per view with the layers of drawing::write_svg,
/// its caption, grid lines and tags, and the frame. Styles once; neither time nor path of this run.
void write_svg(const Sheet& sheet, const model::Model& model, drawing::Sink sink);

}  // namespace strake::sheets
