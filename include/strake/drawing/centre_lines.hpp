// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

namespace strake::drawing {

struct CentreLineOptions {
  /// Round parts of a smaller diameter on paper have none, mm.
  double min_diameter_mm = 2;
};

/// Reads "on", "off" (none), or the least diameter on paper, as "4mm". Errors: usage.
[[nodiscard]] Result<std::optional<CentreLineOptions>> parse_centre_lines(std::string_view text);

/// Returns the centre lines of what has ink in a drawing (ISO 128-2, type 04): the axes of
/// cylinders, cones, dishes and rings, the middles of bends, and a cross in each circle that is
/// seen head-on. They come from the exact primitives of the model and from the curves of the
/// drawing, not from meshes.
///
/// An axis is drawn as far as lines of its object run beside it, so what is hidden has one only
/// where hidden lines have ink, and what is cut off none. Axes in line, of one object or several,
/// are one line. A line goes on beyond the outline by a quarter of the diameter, 1 mm at least and
/// 3 mm at most, but where it ends at a bend or at a cut. A view in perspective has none. The
/// result does not depend on the team. Errors: cancelled.
[[nodiscard]] Result<std::vector<CentreLine>> find_centre_lines(const NeutralDrawing& drawing,
                                                                const Ink& ink,
                                                                const model::Model& model,
                                                                const CentreLineOptions& options,
                                                                const parallel::Context& context);

}  // namespace strake::drawing
