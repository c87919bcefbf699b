// SPDX-License-Identifier: Apache-2.0
// Dense lines of an object thinned, so that they do not fill to black on paper.
#pragma once

#include <optional>
#include <string_view>

#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/parallel/context.hpp"

namespace strake::drawing {

struct ThinOptions {
  /// Lines are thinned that stand nearer on paper, from the middle of one to that of the next, mm;
  /// 0: two wide pens of the style of the object, which leaves a pen of white between two lines.
  double spacing_mm = 0;
  /// Model space of DXF lacks the lines, too. It is at true size, where none is too near.
  bool in_model_space = false;
};

/// Reads "on", "off" (none), or a spacing on paper, as "0.5mm"; with "+dxf" behind it model space
/// of DXF is thinned, too. Errors: usage.
[[nodiscard]] Result<std::optional<ThinOptions>> parse_thinning(std::string_view text);

/// Leaves visible lines out of the ink that run along others of their own object nearer than a
/// spacing, on both sides: inner lines of a dense patch, as those of a corrugated wall. What is at
/// the rim of a patch stays, as do outlines of cuts and hatches, and lines of different objects do
/// not thin each other; so no object vanishes, and equal objects get equal ink. Of the inner lines
/// those stay that are a spacing apart, counted across them.
///
/// Cost: an object's lines are found in grid cells, and each asks a bounded number of lines of a
/// cell; objects in parallel. The result does not depend on the team. Errors: cancelled.
[[nodiscard]] Status thin_lines(Ink& ink, const NeutralDrawing& drawing, const ThinOptions& options,
                                const parallel::Context& context);

}  // namespace strake::drawing
