// SPDX-License-Identifier: Apache-2.0
// The layers of a view, written as SVG.
#pragma once

#include <string_view>

#include "drawing/buffered_writer.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/model/model.hpp"

namespace strake::drawing {

/// Writes the lines of a view: a group per layer, of class "visible sharp" and the like, and in it
/// a group per object with one path. `prefix` stands before the ids of the layers.
void write_layers(BufferedWriter& out, const PaperCurves& curves, const Ink& ink,
                  const model::Model& model, std::string_view prefix);

/// Writes an element of metadata for each object that was left out because it lies far from all
/// others.
void write_far_objects(BufferedWriter& out, const NeutralDrawing& drawing,
                       const model::Model& model);

}  // namespace strake::drawing
