// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

namespace strake::drawing {

/// Which of two lines stays where they lie on each other: the lower rank, then the nearer.
enum class Rank : std::uint8_t { visible, hidden, none };  ///< none: covers nothing, is not covered

/// A line in a plane, in whatever unit the caller measures.
struct Flat {
  Flat() = default;
  Flat(double from_x, double from_y, double to_x, double to_y);

  double ax = 0, ay = 0, bx = 0, by = 0;
  double dx = 0, dy = 0, length = 0;  ///< unit direction from a to b
  double depth = 0;                   ///< larger is nearer to the viewer
  double reach = 0;  ///< two lines lie on each other up to the sum of their reaches
  Rank rank = Rank::none;
};

struct OverlapRule {
  /// Common stretches no longer than this are not looked at, unless a whole line lies in one.
  double least = 0;
  double greatest_sine = 1;  ///< of the angle between two lines that lie on each other
  bool covers_visible = true;
  /// Stretches of a cut line that are no longer than this, nor than what is covered beside them,
  /// count as covered.
  double shortest = 0;
};

/// Part of a line, as parameters 0 at a to 1 at b, that lies on nothing or on what stays.
struct Stretch {
  std::uint32_t line = 0;
  bool covered = false;
  double from = 0, to = 1;
};

/// Cuts lines where they lie on lines that stay: of two, the one of lower rank, then the nearer,
/// then the first. Stretches come by line, then from a to b, and leave no gap.
///
/// Cost: lines that share a cell of a grid are compared with each other. The same for any team.
[[nodiscard]] Result<std::vector<Stretch>> cut_overlaps(std::span<const Flat> lines,
                                                        const OverlapRule& rule,
                                                        const parallel::Context& context);

}  // namespace strake::drawing
