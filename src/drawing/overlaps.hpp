// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "drawing/flat.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

namespace strake::drawing {

struct OverlapRule {
  /// Common stretches no longer than this are not looked at, unless a whole line lies in one.
  double least = 0;
  /// Of the angle between two lines that lie on each other; no more in any case than twice their
  /// distance over the shorter one's length, within which a line that lies on another as a whole
  /// always is.
  double greatest_sine = 1;
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

/// Stretches of the lines that lie on others: by line, then from a to b, without a gap. Lines that
/// are not named lie on nothing.
using Stretches = std::vector<Stretch>;

/// Cuts lines where they lie on lines that stay: of two, the one of lower rank, then the nearer,
/// then the first.
///
/// Cost: a line is compared with those of its direction in its place (LineIndex), longer and
/// shorter ones. 24 bytes a line and as many for each stretch that is covered in part, 32 while
/// they are sorted. The same for any team.
[[nodiscard]] Result<Stretches> cut_overlaps(std::span<const Flat> lines, const OverlapRule& rule,
                                             const parallel::Context& context);

/// Parameters of a line.
struct Interval {
  double from, to;
};

/// The definition, line by line: the stretch of `line` that `other` lies on, when the two coincide
/// there.
[[nodiscard]] std::optional<Interval> covered(const Flat& line, const Flat& other,
                                              const OverlapRule& rule);

/// Whether line i stays where both i and j are: a total order.
[[nodiscard]] bool stays(std::span<const Flat> lines, std::uint32_t i, std::uint32_t j);

/// Whether a line may be covered at all.
[[nodiscard]] bool may_go(const Flat& line, const OverlapRule& rule);

/// Appends a line cut at the intervals that are covered, in any order.
void append_stretches(Stretches& out, std::uint32_t line, std::span<Interval> covers,
                      double shortest);

}  // namespace strake::drawing
