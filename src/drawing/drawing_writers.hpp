// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "core/output_format.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/write.hpp"
#include "strake/model/scene.hpp"

namespace strake::drawing {

/// What a drawing is written from.
struct DrawingContents {
  const NeutralDrawing& drawing;
  const Ink& ink;  ///< empty where no writer in use needs it
  const model::Model& model;
  const model::Scene* scene = nullptr;  ///< what was drawn, where it is known: for what shows it
};

/// One format that drawings are written in.
struct DrawingWriter {
  OutputFormat format;
  bool needs_ink = false;  ///< whether it shows what choose_ink() chose, not the whole drawing
  /// Returns what of the drawing could not be written as it is. Errors: cancelled, out of memory.
  Result<Diagnostics> (*write)(const DrawingContents& contents, Sink sink,
                               const parallel::Context& context);
};

/// Returns the writers of all formats, in the order of help and errors.
[[nodiscard]] std::span<const DrawingWriter> drawing_writers();

}  // namespace strake::drawing
