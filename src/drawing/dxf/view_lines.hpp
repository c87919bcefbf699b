// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "drawing/dxf/groups.hpp"
#include "drawing/dxf/layer_style.hpp"
#include "drawing/dxf/model_plane.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/drawing/write.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

namespace strake::drawing::dxf {

/// The lines of a view, and where they lie in model space.
struct ViewLines {
  const PaperCurves& curves;
  const Ink& ink;
  const ModelPlane& plane;
  const StyleLayers& style_layers;
};

/// Returns as many handles as the entities of a view need at most: one for a line.
[[nodiscard]] inline std::size_t entities_at_most(const Ink& ink) {
  return ink.in_model_space().size() + ink.centre_lines.size() + ink.break_lines.size();
}

/// Writes the lines of a view as entities of model space, layer by layer and object by object, and
/// its centre lines. Each entity says whose it is: id, name and file of the object (decision 0078),
/// and by what factor the dashes of its layer fit it. Handles count from `first`. `layers` begin
/// with those of ViewLayer. Errors: cancelled, out of memory.
[[nodiscard]] Status write_view_lines(const ViewLines& view, const model::Model& model,
                                      std::span<const LayerStyle> layers, Handle first, Sink sink,
                                      const parallel::Context& context);

}  // namespace strake::drawing::dxf
