// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/marks.hpp"

namespace strake::drawing {

/// Which of two lines stays where they lie on each other: the lower rank, then the nearer.
enum class Rank : std::uint8_t { visible, hidden, none };  ///< none: covers nothing, is not covered

/// Both ends of a line, the same whichever way it runs.
using SegmentEnds = std::array<double, 4>;

/// A line in a plane, in whatever unit the caller measures.
struct PlaneSegment {
  double ax = 0, ay = 0, bx = 0, by = 0;
  double depth = 0;  ///< larger is nearer to the viewer
  double reach = 0;  ///< two lines lie on each other up to the sum of their reaches
  Rank rank = Rank::none;

  [[nodiscard]] double length() const {
    const double x = bx - ax, y = by - ay;
    return std::sqrt(x * x + y * y);
  }
  [[nodiscard]] SegmentEnds ends() const {
    if (bx < ax || (bx == ax && by < ay)) return {bx, by, ax, ay};
    return {ax, ay, bx, by};
  }
};

struct OverlapRule {
  /// Common stretches no longer than this are not looked at.
  double least = 0;
  /// Of the angle between two lines that lie on each other; no more in any case than twice their
  /// distance over the shorter one's length, within which a line that lies on another as a whole
  /// always is.
  double greatest_sine = 1;
  bool covers_visible = true;
  bool hidden_covers = true;  ///< otherwise visible lines alone cover others
  /// Stretches of a cut line that are no longer than this, nor than what is covered beside them,
  /// count as covered.
  double shortest = 0;
};

/// Part of a line, as parameters 0 at a to 1 at b, that lies on nothing or on what stays.
struct LineInterval {
  std::uint32_t line = 0;
  bool covered = false;
  double from = 0, to = 1;
};

/// By line, then from a to b, without a gap.
using LineIntervals = std::vector<LineInterval>;

/// What of lines lies on others.
struct LineOverlaps {
  parallel::Marks wholly;   ///< by line: all of it lies on one other
  LineIntervals stretches;  ///< of other lines that lie on some
};

/// Cuts lines where they lie on lines that stay: of two, the one of lower rank, then the nearer,
/// then the first.
///
/// Cost: lines with the same ends are one. A line is compared with those of its direction in its
/// place (LineIndex), longer and shorter ones. 32 bytes a line while all are sorted, then 16, and
/// 84 for each that has no twin, and 24 for each stretch that is covered in part. The same for any
/// team.
[[nodiscard]] Result<LineOverlaps> cut_overlaps(std::span<const PlaneSegment> lines,
                                                const OverlapRule& rule,
                                                const parallel::Context& context);

/// Parameters of a line.
struct ParamInterval {
  double from, to;
};

/// The definition, line by line: the stretch of `line` that `other` lies on, when the two coincide
/// there. All of it where they have the same ends, whatever rounding would make of that.
[[nodiscard]] std::optional<ParamInterval> covered(const PlaneSegment& line,
                                                   const PlaneSegment& other,
                                                   const OverlapRule& rule);

/// Whether line i stays where both i and j are: a total order.
[[nodiscard]] bool has_precedence(std::span<const PlaneSegment> lines, std::uint32_t i,
                                  std::uint32_t j);

[[nodiscard]] bool has_precedence(const PlaneSegment& a, std::uint32_t i, const PlaneSegment& b,
                                  std::uint32_t j);

/// Whether a line may be covered at all.
[[nodiscard]] bool can_be_covered(const PlaneSegment& line, const OverlapRule& rule);

/// Whether it may cover others.
[[nodiscard]] bool can_cover(const PlaneSegment& line, const OverlapRule& rule);

/// Appends a line cut at the intervals that are covered, in any order.
void append_intervals(LineIntervals& out, std::uint32_t line, std::span<ParamInterval> covers,
                      double shortest);

}  // namespace strake::drawing
