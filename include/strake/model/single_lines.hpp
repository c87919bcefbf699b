// SPDX-License-Identifier: Apache-2.0
// Thin pipes as single lines: a scene in which their axes stand for them.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::model {

struct SingleLineOptions {
  double largest_diameter_mm = 0;  ///< outer diameter of the thickest pipe that becomes a line
};

/// Reads "off" (none), an outer diameter, as "60mm", or a nominal size of ISO 6708 from DN6 to
/// DN600, as "DN50", which stands for the outer diameter of EN 10220 and 1 % more. Errors: usage.
[[nodiscard]] Result<std::optional<SingleLineOptions>> parse_single_line(std::string_view text);

/// A scene with pipes as lines.
struct SingleLines {
  Scene scene;
  std::uint64_t bodies = 0;  ///< bodies that became lines
};

/// Returns a scene in which the pipes of `scene` up to a diameter are their axes (ISO 6412): wires
/// of GridShapes that say so (GridShape::single_line), which hide nothing. Its objects, bodies and
/// the model are the same, so selections of the one hold for the other.
///
/// Pipes are exact primitives: cylinders at least as long as they are thick and bends; and, where
/// both of their ends meet such pieces of the same diameter, shorter cylinders and reducers. So
/// flanges, valves and bodies of meshes stay what they are. A bend becomes the arc of its axis, as
/// chords within 0.1 mm. Errors: cancelled.
[[nodiscard]] Result<SingleLines> pipes_as_lines(const Scene& scene,
                                                 const SingleLineOptions& options,
                                                 const parallel::Context& context);

}  // namespace strake::model
