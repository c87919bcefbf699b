// SPDX-License-Identifier: Apache-2.0
// The lines of a view on a page: its layers, and what the metadata say of it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drawing/pdf/pdf_document.hpp"
#include "drawing/strokes/layer_pens.hpp"
#include "drawing/strokes/layers.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

namespace strake::drawing {

/// Returns the operators that choose a pen.
[[nodiscard]] std::string pdf_pen(const LinePen& pen);

/// The layers of the styles of objects that have names, by style; lines of them lie in the layer of
/// their kind and in that of their style.
using PdfStyleLayers = std::vector<std::optional<PdfLayerId>>;

/// Adds a layer for each name of a style that lines of the views have.
[[nodiscard]] PdfStyleLayers add_style_layers(PdfDocument& document,
                                              std::span<const Ink* const> views);

/// The pens of a view.
struct PdfPens {
  PenOfLayer of;
  LinePen centre_lines, break_lines;
  const PdfStyleLayers& style_layers;
};

/// Adds the lines of a view to the page: a layer for each kind of line, below `parent` if there is
/// one, two more by which hidden lines are switched by what hides them, and one of centre lines. In
/// a layer the path of each object is marked with the object's id, name and file. Dashes fit each
/// line (dash_runs); those of hidden lines that are not kept apart go on from what one cause hides
/// to what the other does. Errors: cancelled, out of memory.
[[nodiscard]] Status add_pdf_view(PdfDocument& document, std::optional<PdfLayerId> parent,
                                  const PaperCurves& curves, const Ink& ink,
                                  const model::Model& model, const PdfPens& pens,
                                  const parallel::Context& context);

/// Returns what the metadata of a document say of a view: the facts that SVG states, as XML.
[[nodiscard]] std::string pdf_facts(const NeutralDrawing& drawing, const Ink& ink,
                                    const model::Model& model);

}  // namespace strake::drawing
