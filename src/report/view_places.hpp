// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "strake/report/view_diff.hpp"

namespace strake::report {

/// A stretch of a piece on which another piece lies, and what that one is.
struct Cover {
  double from_mm = 0, to_mm = 0;  ///< from the piece's end a
  LineClass cls;
  bool after = false;  ///< of the newer drawing
};

/// The stretch of `piece` on which `other` lies: where they are at most `tolerance_mm` apart, if
/// they are parallel for their lengths (their sine at most twice that over the shorter one's).
[[nodiscard]] std::optional<std::pair<double, double>> common_stretch(const ViewPiece& piece,
                                                                      const ViewPiece& other,
                                                                      double tolerance_mm);

/// Cuts a piece where what lies on it changes. `covers` are of both drawings, in any order; those
/// of the same class in the piece's own drawing need not be there.
void append_stretches(std::vector<LineStretch>& out, std::uint32_t piece, double length_mm,
                      const LineClass& cls, bool after, std::span<const Cover> covers,
                      double tolerance_mm);

}  // namespace strake::report
