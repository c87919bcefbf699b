// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "drawing/flat.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/marks.hpp"

namespace strake::drawing {

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
struct Stretch {
  std::uint32_t line = 0;
  bool covered = false;
  double from = 0, to = 1;
};

/// By line, then from a to b, without a gap.
using Stretches = std::vector<Stretch>;

/// What of lines lies on others.
struct Overlaps {
  parallel::Marks wholly;  ///< by line: all of it lies on one other
  Stretches stretches;     ///< of other lines that lie on some
};

/// Cuts lines where they lie on lines that stay: of two, the one of lower rank, then the nearer,
/// then the first.
///
/// Cost: lines with the same ends are one. A line is compared with those of its direction in its
/// place (LineIndex), longer and shorter ones. 32 bytes a line while all are sorted, then 16, and
/// 84 for each that has no twin, and 24 for each stretch that is covered in part. The same for any
/// team.
[[nodiscard]] Result<Overlaps> cut_overlaps(std::span<const Flat> lines, const OverlapRule& rule,
                                            const parallel::Context& context);

/// Parameters of a line.
struct Interval {
  double from, to;
};

/// The definition, line by line: the stretch of `line` that `other` lies on, when the two coincide
/// there. All of it where they have the same ends, whatever rounding would make of that.
[[nodiscard]] std::optional<Interval> covered(const Flat& line, const Flat& other,
                                              const OverlapRule& rule);

/// Whether line i stays where both i and j are: a total order.
[[nodiscard]] bool stays(std::span<const Flat> lines, std::uint32_t i, std::uint32_t j);

[[nodiscard]] bool stays(const Flat& a, std::uint32_t i, const Flat& b, std::uint32_t j);

/// Whether a line may be covered at all.
[[nodiscard]] bool may_go(const Flat& line, const OverlapRule& rule);

/// Whether it may cover others.
[[nodiscard]] bool may_cover(const Flat& line, const OverlapRule& rule);

/// Appends a line cut at the intervals that are covered, in any order.
void append_stretches(Stretches& out, std::uint32_t line, std::span<Interval> covers,
                      double shortest);

}  // namespace strake::drawing
