// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/detail/function_ref.hpp"

namespace strake::drawing {

/// Takes text in pieces of some kilobytes, in order: AtomicFile::write, a string's append.
using Sink = parallel::FunctionRef<void(std::string_view)>;

/// SVG in millimetres of paper: one Inkscape layer per class of line, in each one group per object
/// (data-id, data-name) with one path, styles once. Neither time nor path of this run is written.
void write_svg(const NeutralDrawing& drawing, const Ink& ink, const model::Model& model, Sink sink);

/// The neutral drawing as JSON, documented in schemas/view.schema.json. Errors: cancelled, out of
/// memory.
[[nodiscard]] Status write_view_json(const NeutralDrawing& drawing, const model::Model& model,
                                     Sink sink, const parallel::Context& context);

/// The same with the lines as binary rows, for drawings of millions of them: documented in
/// docs/drawing.md. Errors as above.
[[nodiscard]] Status write_view_rows(const NeutralDrawing& drawing, const model::Model& model,
                                     Sink sink, const parallel::Context& context);

/// Text made safe for XML content and quoted attributes: markup escaped, characters that XML
/// forbids and bytes that are no UTF-8 replaced by U+FFFD, and so are the controls that turn the
/// direction of writing, so that a name cannot pass itself off as another.
[[nodiscard]] std::string xml_escaped(std::string_view text);

/// Text as a JSON string, quotes included; bytes that are no UTF-8 become U+FFFD.
[[nodiscard]] std::string json_quoted(std::string_view text);

}  // namespace strake::drawing
