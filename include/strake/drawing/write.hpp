// SPDX-License-Identifier: Apache-2.0
// Writers of drawings: SVG, PDF, DXF, JSON and binary rows.
#pragma once

#include <string_view>

#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/detail/function_ref.hpp"

namespace strake::drawing {

/// Takes text in chunks of some kilobytes to some hundreds, in order:
/// `[&](std::string_view text) { file.write(text); }` for an AtomicFile. It is called by any worker
/// of the team, by one at a time. What it throws comes out of the call that writes.
using Sink = parallel::FunctionRef<void(std::string_view)>;

/// Writes SVG in millimetres of paper: one Inkscape layer per class of line, in each layer one
/// group per object (data-id, data-name) with one path; styles are written once. Neither time nor
/// path of this run is written.
/// All workers make the groups of objects. Errors: cancelled, out of memory.
[[nodiscard]] Status write_svg(const NeutralDrawing& drawing, const Ink& ink,
                               const model::Model& model, Sink sink,
                               const parallel::Context& context);
/// The same by the calling thread alone.
void write_svg(const NeutralDrawing& drawing, const Ink& ink, const model::Model& model, Sink sink);

/// Writes PDF 1.7 of one page of exactly the size of the sheet: the layers, pens and texts of
/// write_svg(), curves within 0.002 mm of paper, the font of the texts embedded. The path of each
/// object is marked with its id, name and file. Neither time nor path of this run is written, and
/// the same drawing gives the same bytes. Returns what the font cannot show
/// ("text-character-missing"). Errors: cancelled, out of memory.
[[nodiscard]] Result<Diagnostics> write_pdf(const NeutralDrawing& drawing, const Ink& ink,
                                            const model::Model& model, Sink sink,
                                            const parallel::Context& context);

/// Writes DXF of AutoCAD 2007 (AC1021, UTF-8), documented in docs/formats/dxf.md: the view in model
/// space at true size in mm, joined lines, arcs, circles and ellipses on a layer per class of line;
/// the sheet as a layout of its size with a viewport at the drawing's scale. Each entity carries
/// id, name and file of its object. Neither time nor path of this run is written. Errors:
/// cancelled, out of memory.
[[nodiscard]] Status write_dxf(const NeutralDrawing& drawing, const Ink& ink,
                               const model::Model& model, Sink sink,
                               const parallel::Context& context);

/// Writes the neutral drawing as JSON, documented in schemas/view.schema.json. Errors: cancelled,
/// out of memory.
[[nodiscard]] Status write_view_json(const NeutralDrawing& drawing, const model::Model& model,
                                     Sink sink, const parallel::Context& context);

/// Writes the neutral drawing with its lines as binary rows, for drawings of millions of them:
/// documented in docs/drawing.md. Errors: cancelled, out of memory.
[[nodiscard]] Status write_view_rows(const NeutralDrawing& drawing, const model::Model& model,
                                     Sink sink, const parallel::Context& context);

/// Returns text made safe for XML content and quoted attributes. Markup is escaped; characters that
/// XML forbids, bytes that are no UTF-8, and controls that turn the direction of writing (with
/// which a name could pass itself off as another) are replaced by U+FFFD.
[[nodiscard]] std::string xml_escaped(std::string_view text);

/// Returns text as a JSON string, quotes included; bytes that are no UTF-8 become U+FFFD.
[[nodiscard]] std::string json_quoted(std::string_view text);

}  // namespace strake::drawing
