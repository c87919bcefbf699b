// SPDX-License-Identifier: Apache-2.0
// Strokes as the commands of SVG paths.
#pragma once

#include <string>

#include "drawing/strokes/strokes.hpp"

namespace strake::drawing {

/// Appends the commands of a path of straight lines: "M0 0L1 0 1 1Z".
void append_svg_chain(std::string& out, const Chain& chain);

/// Appends a path with elliptical arcs ("A") for each arc of the stroke.
void append_svg_path(std::string& out, const Stroke& stroke);

}  // namespace strake::drawing
