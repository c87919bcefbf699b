// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/write.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// Writes a sheet as SVG in millimetres of paper: a group per view with the layers of
/// drawing::write_svg and its marks, and the marks of the sheet. Styles are written once; neither
/// time nor path of this run is.
void write_svg(const Sheet& sheet, const model::Model& model, drawing::Sink sink);

/// Writes sheets of one model as PDF 1.7, a page each, of exactly its size: per view a layer that
/// holds those of drawing::write_pdf and its marks; bookmarks of sheets and views. Of a template
/// the elements that title blocks are made of are drawn; what is left out, and characters that the
/// font lacks, are returned ("template-part-left-out", "text-character-missing"). The same sheets
/// give the same bytes. Errors: usage where there is no sheet; cancelled, out of memory.
[[nodiscard]] Result<Diagnostics> write_pdf(std::span<const Sheet> sheets,
                                            const model::Model& model, drawing::Sink sink,
                                            const parallel::Context& context);

/// Writes sheets of one model as DXF (drawing::write_dxf): views at true size in model space, one
/// beside the other as on the sheet, and the sheets side by side; each sheet as a layout of its
/// size, with a viewport for each view and all marks, each class on its layer. Returns what of
/// templates is not drawn ("template-part-left-out"). Errors: usage where there is no sheet;
/// cancelled, out of memory.
[[nodiscard]] Result<Diagnostics> write_dxf(std::span<const Sheet> sheets,
                                            const model::Model& model, drawing::Sink sink,
                                            const parallel::Context& context);

}  // namespace strake::sheets
