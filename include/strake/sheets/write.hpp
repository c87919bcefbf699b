// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/drawing/write.hpp"
#include "strake/model/model.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// Writes a sheet as SVG in millimetres of paper: a group per view with the layers of
/// drawing::write_svg, its caption, grid lines and tags, and the frame. Styles are written once;
/// neither time nor path of this run is.
void write_svg(const Sheet& sheet, const model::Model& model, drawing::Sink sink);

}  // namespace strake::sheets
