// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "strake/drawing/drawing.hpp"

namespace strake::drawing {

/// Points to be joined by straight lines; closed when the last is the first.
using Chain = std::vector<PaperPoint>;

/// A chain, and by stretch between two of its points the line that it is of.
struct JoinedLines {
  Chain points;
  std::vector<const Line*> lines;
};

/// Joins lines that meet end to end on paper into chains, each line once.
///
/// A chain begins with the first line not yet drawn that has a free end, or failing that with the
/// first not yet drawn, and at a fork goes on with the first: the order of the lines alone decides.
/// Lines without length are left out.
[[nodiscard]] std::vector<JoinedLines> join_lines(std::span<const Line* const> lines);

/// Appends the commands of a path of straight lines: "M0 0L1 0 1 1Z".
void append_svg_chain(std::string& out, const Chain& chain);

/// The same, with an elliptical arc ("A") for each run of chords of one curve. The arc begins and
/// ends where the run does; a curve that is seen edge-on stays straight.
void append_svg_path(std::string& out, const JoinedLines& chain, const PaperCurves& curves);

}  // namespace strake::drawing
