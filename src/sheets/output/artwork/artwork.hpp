// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "drawing/pdf/pdf_document.hpp"
#include "sheets/output/artwork/artwork_canvas.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// Appends the operators that draw a template on paper of that size: paths, lines, shapes, texts
/// and groups with their transforms, and `use` of these, with the styles of attributes and style
/// sheets. Texts are in the font of the document, whatever the template says; lines under a
/// transform that stretches one way are as wide as it is in the mean.
///
/// Adds "template-part-left-out" for each kind of thing that is not drawn, as pictures, gradients
/// and clipping. Errors: input, where the elements are no XML.
[[nodiscard]] Status append_artwork(std::string& out, drawing::PdfDocument& document,
                                    const Sheet::Template& artwork, const drawing::PaperSize& paper,
                                    Diagnostics& diagnostics);

/// Draws a template on a canvas of that size; `format` is what people call the file. Adds
/// "template-part-left-out". Errors: input, where the elements are no XML.
[[nodiscard]] Status draw_artwork(ArtworkCanvas& canvas, const Sheet::Template& artwork,
                                  const drawing::PaperSize& paper, std::string_view format,
                                  Diagnostics& diagnostics);

}  // namespace strake::sheets
