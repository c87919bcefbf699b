// SPDX-License-Identifier: Apache-2.0
// The lines of a sheet, found by where they are: whether one runs through a box that may be askew.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sheets/spec/paper_segments.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// A box whose sides run along `way`, a unit vector, and across it.
struct TurnedBox {
  PaperPoint middle, way;
  double half_length = 0, half_height = 0;
};

/// Straight lines in square bins of paper. A query looks at those of the bins that it reaches, and
/// its answer is exact.
class LineBins {
 public:
  LineBins(double width_mm, double height_mm);

  void add(const PaperSegment& line);
  [[nodiscard]] bool any_in(const TurnedBox& box) const;

 private:
  template <class Visit>
  bool each_bin(const PaperBox& box, Visit&& visit) const;

  PaperBox paper_;
  std::size_t columns_, rows_;
  std::vector<PaperSegment> lines_;
  std::vector<std::vector<std::uint32_t>> bins_;
};

}  // namespace strake::sheets
