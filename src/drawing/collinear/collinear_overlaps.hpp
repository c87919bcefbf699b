// SPDX-License-Identifier: Apache-2.0
// Overlaps of lines in a plane: which lines, or intervals of them, lie on others that stay.
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

/// The rank of a line: of two that lie on each other the one of lower rank stays, then the nearer.
enum class OverlapRank : std::uint8_t {
  visible,
  hidden,
  none
};  ///< none: neither covers nor is covered

/// Both ends of a line, equal for both ways of running.
using SegmentEnds = std::array<double, 4>;

/// A line segment in a plane, in the caller's unit.
struct PlaneSegment {
  double ax = 0, ay = 0, bx = 0, by = 0;
  double depth = 0;  ///< larger is nearer to the viewer
  double reach = 0;  ///< two lines coincide within the sum of their reaches
  OverlapRank rank = OverlapRank::none;

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
  /// Common intervals no longer than this are ignored.
  double least = 0;
  /// The largest sine of the angle between two coincident lines. In any case it is at most twice
  /// their distance over the shorter one's length, which holds for any line that lies on another as
  /// a whole.
  double greatest_sine = 1;
  bool covers_visible = true;
  bool hidden_covers = true;  ///< otherwise only visible lines cover others
  /// Intervals of a cut line that are no longer than this, nor than what is covered beside them,
  /// count as covered.
  double shortest = 0;
};

/// An interval of a line, with parameters from 0 at a to 1 at b: free, or covered by a line that
/// stays.
struct LineInterval {
  std::uint32_t line = 0;
  bool covered = false;
  double from = 0, to = 1;
};

/// Intervals by line, then from a to b, without a gap.
using LineIntervals = std::vector<LineInterval>;

/// The lines, and intervals of lines, that lie on others.
struct LineOverlaps {
  parallel::Marks fully_covered;  ///< by line: one other line covers all of it
  LineIntervals cut_intervals;    ///< intervals of the other lines that are covered in part
};

/// Cuts lines where they lie on lines that stay: of two coincident lines the one of lower rank
/// stays, then the nearer, then the first.
///
/// Cost: coincident lines with the same ends count as one. A line is compared with longer and
/// shorter lines of its direction in its place (LineIndex). Memory is 32 bytes a line during the
/// sort, then 16, and 84 for each line without a coincident one, and 24 for each interval that is
/// covered in part. The result does not depend on the team.
[[nodiscard]] Result<LineOverlaps> cut_overlaps(std::span<const PlaneSegment> lines,
                                                const OverlapRule& rule,
                                                const parallel::Context& context);

/// An interval of parameters on a line.
struct ParamInterval {
  double from, to;
};

/// Unites intervals that have a point in common, and puts them in order.
void unite(std::vector<ParamInterval>& intervals);

/// The definition for one pair: returns the interval of `line` on which `other` coincides with it.
/// It is all of `line` where they have the same ends, whatever rounding would make of that.
[[nodiscard]] std::optional<ParamInterval> covered(const PlaneSegment& line,
                                                   const PlaneSegment& other,
                                                   const OverlapRule& rule);

/// Returns whether line i stays where i and j coincide: a total order.
[[nodiscard]] bool has_precedence(std::span<const PlaneSegment> lines, std::uint32_t i,
                                  std::uint32_t j);

[[nodiscard]] bool has_precedence(const PlaneSegment& a, std::uint32_t i, const PlaneSegment& b,
                                  std::uint32_t j);

/// Returns whether a line may be covered at all.
[[nodiscard]] bool can_be_covered(const PlaneSegment& line, const OverlapRule& rule);

/// Returns whether a line may cover others.
[[nodiscard]] bool can_cover(const PlaneSegment& line, const OverlapRule& rule);

/// Appends a line cut at its covered intervals, which come in any order.
void append_intervals(LineIntervals& out, std::uint32_t line, std::span<ParamInterval> covers,
                      double shortest);

}  // namespace strake::drawing
