// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "drawing/chains.hpp"
#include "strake/drawing/drawing.hpp"

namespace strake::drawing {

/// Appends the commands of a path of straight lines: "M0 0L1 0 1 1Z".
void append_svg_chain(std::string& out, const Chain& chain);

/// The same, with an elliptical arc ("A") for each run of chords of one curve. The arc begins and
/// ends where the run does; a curve that is seen edge-on stays straight.
void append_svg_path(std::string& out, const JoinedLines& chain, const PaperCurves& curves);

}  // namespace strake::drawing
