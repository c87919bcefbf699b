// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/report/view_diff.hpp"

/// Finds lines of two drawings that lie on each other, and what changed along them.
namespace strake::report {

/// An interval of a piece on which another piece lies, with the class of that one.
struct CoveredInterval {
  double from_mm = 0, to_mm = 0;  ///< measured from the piece's end a
  DiffLineClass cls;
  bool after = false;  ///< it is of the newer drawing
};

/// Returns the interval of `piece` on which `other` lies: where they are at most `tolerance_mm`
/// apart, if they are parallel for their lengths (their sine at most twice that over the shorter
/// one's).
[[nodiscard]] std::optional<std::pair<double, double>> common_interval(const ViewPiece& piece,
                                                                       const ViewPiece& other,
                                                                       double tolerance_mm);

/// Cuts a piece where what lies on it changes. `covers` are of both drawings, in any order; those
/// of the same class in the piece's own drawing may be left out.
void append_diff_intervals(std::vector<DiffInterval>& out, std::uint32_t piece, double length_mm,
                           const DiffLineClass& cls, bool after,
                           std::span<const CoveredInterval> covers, double tolerance_mm);

/// A piece of either drawing with its class in the comparison.
struct ClassedPiece {
  const ViewPiece* piece = nullptr;
  DiffLineClass cls;
  bool after = false;
};

/// Marks pieces that have an equal in the other drawing: of one class, between the same ends.
[[nodiscard]] std::vector<std::uint8_t> find_equal_pieces(std::span<const ClassedPiece> pieces);

/// What lies on a piece that has no equal; `of` is the piece.
struct PieceCoverage {
  std::uint32_t of = 0;
  CoveredInterval cover;
};

/// Returns the coverage by piece. Errors: input where too many lines are at one place; cancelled.
[[nodiscard]] Result<std::vector<PieceCoverage>> find_coverage(
    std::span<const ClassedPiece> pieces, std::span<const std::uint8_t> has_equal,
    double tolerance_mm, const parallel::Context& context);

}  // namespace strake::report
