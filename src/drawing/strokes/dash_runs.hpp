// SPDX-License-Identifier: Apache-2.0
// Chains of dashed lines, cut at their corners, each part with dashes that fit it.
#pragma once

#include <span>
#include <vector>

#include "drawing/strokes/join_lines.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"

namespace strake::drawing {

/// A stroke that is dashed for itself: it begins with the first dash of the pattern, whose lengths
/// are all multiplied by `stretch`; 0: continuous.
struct DashRun {
  JoinedLines chain;
  double stretch = 1;
};

/// Cuts a chain at its corners, so that lines begin, end and turn with a dash (ISO 128-2), and fits
/// the pattern to each part. A part too short for a gap goes on round its corner with the next, and
/// a closed chain that has none but such is one stroke, as the head of a bolt. Curves have no
/// corners, and count with the lengths of their arcs.
[[nodiscard]] std::vector<DashRun> dash_runs(const JoinedLines& chain, const PaperCurves& curves,
                                             std::span<const double> dash_mm);

/// Returns by what factor the pattern is stretched for a centre line, mm of paper; 0: continuous.
[[nodiscard]] double stretch_of(const CentreLine& line, std::span<const double> dash_mm);

}  // namespace strake::drawing
