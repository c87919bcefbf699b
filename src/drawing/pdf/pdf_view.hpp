// SPDX-License-Identifier: Apache-2.0
// The lines of a view on a page: its layers, and what the metadata say of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drawing/pdf/pdf_document.hpp"
#include "drawing/strokes/layers.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/detail/function_ref.hpp"

namespace strake::drawing {

/// How lines are drawn, mm of paper.
struct PdfPen {
  double width_mm = 0.25;
  std::vector<double>
      dash_mm;  ///< lengths of ink and gap by turns, flat at their ends; empty: none
  model::Color color{0, 0, 0, 255};
};

/// Returns the operators that choose a pen.
[[nodiscard]] std::string pdf_pen(const PdfPen& pen);

/// The pens of a view.
struct PdfPens {
  /// The pen of a layer; of a hidden one, for the lines that are hidden in this way.
  parallel::FunctionRef<PdfPen(const Layer&, LineState)> of;
  PdfPen centre_lines, break_lines;
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
