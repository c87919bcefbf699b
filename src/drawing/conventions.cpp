// SPDX-License-Identifier: Apache-2.0
#include "drawing/conventions.hpp"

#include <utility>

#include "strake/drawing/break_lines.hpp"

namespace strake::drawing {

Status apply_conventions(Ink& ink, const NeutralDrawing& drawing, const model::Model& model,
                         const Conventions& conventions, const parallel::Context& context) {
  if (conventions.centre_lines) {
    auto lines = find_centre_lines(drawing, ink, model, *conventions.centre_lines, context);
    if (!lines) return lines.error();
    ink.centre_lines = std::move(*lines);
  }
  if (conventions.break_lines) {
    auto lines = find_break_lines(drawing, context);
    if (!lines) return lines.error();
    ink.break_lines = std::move(*lines);
  }
  return conventions.thin ? thin_lines(ink, drawing, *conventions.thin, context) : Status();
}

}  // namespace strake::drawing
