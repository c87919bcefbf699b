// SPDX-License-Identifier: Apache-2.0
// The layers of a view, written as SVG.
#pragma once

#include <span>
#include <string_view>

#include "drawing/buffered_writer.hpp"
#include "drawing/strokes/layer_pens.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/model/model.hpp"

namespace strake::drawing {

/// Writes the lines of a view: a group per layer, of class "visible sharp" and the like, and in it
/// a group per object with one path, or for dashed lines one for each pattern that fits them
/// (dash_runs). Where hidden lines are kept apart, the layer has a layer for each state within it,
/// and lines of objects with a style lie in a layer of class "style-1" and the like within these.
/// Only the dashes of hidden lines and of styles count here, the rest is in
/// svg_style_rules() and in what the caller writes. `prefix` stands before the ids of the layers.
/// All workers make the groups of objects. Errors: cancelled, out of memory.
[[nodiscard]] Status write_layers(BufferedWriter& out, const PaperCurves& curves, const Ink& ink,
                                  const model::Model& model, std::string_view prefix,
                                  PenOfLayer pen_of, const parallel::Context& context);
/// The same by the calling thread alone.
void write_layers(BufferedWriter& out, const PaperCurves& curves, const Ink& ink,
                  const model::Model& model, std::string_view prefix, PenOfLayer pen_of);

/// Writes the layer of break lines, of class "break", where there are any.
void write_break_lines(BufferedWriter& out, const Ink& ink, std::string_view prefix);

/// Writes the layer of centre lines, of class "centre", where there are any. Their dashes fit each
/// of them.
void write_centre_lines(BufferedWriter& out, const Ink& ink, std::string_view prefix,
                        std::span<const double> dash_mm);

/// Writes an element of metadata for each object that was left out because it lies far from all
/// others.
void write_far_objects(BufferedWriter& out, const NeutralDrawing& drawing,
                       const model::Model& model);

}  // namespace strake::drawing
