// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// The occupied paper of a sheet, in squares of about a millimetre: how much ink lies in each,
/// whether texts block it, and how many leaders run through.
class OccupancyGrid {
 public:
  OccupancyGrid(double width_mm, double height_mm);

  void add_line(const PaperPoint& a, const PaperPoint& b);
  void add_leader(const PaperPoint& a, const PaperPoint& b);
  /// Blocks a box: nothing else may be written there.
  void block(const PaperBox& box);

  /// Returns whether no square of the box, which must lie on the sheet, is blocked.
  [[nodiscard]] bool is_open(const PaperBox& box) const;
  /// Returns the millimetres of lines in the box.
  [[nodiscard]] double ink(const PaperBox& box) const;
  /// The path of a leader: the squares with leaders that it crosses, meaningless where it is
  /// blocked.
  struct LeaderPath {
    bool open = true;
    std::size_t crossed = 0;
  };
  [[nodiscard]] LeaderPath way(const PaperPoint& a, const PaperPoint& b) const;

 private:
  struct OccupancyCell {
    float ink = 0;
    std::uint16_t leaders = 0;
    bool blocked = false;
  };
  [[nodiscard]] std::size_t column(double x) const;
  [[nodiscard]] std::size_t row(double y) const;
  template <class Take>
  void walk(const PaperPoint& a, const PaperPoint& b, Take&& take) const;
  template <class Take>
  void each(const PaperBox& box, Take&& take) const;

  double size_ = 1;
  std::size_t columns_ = 1, rows_ = 1;
  std::vector<OccupancyCell> cells_;
};

}  // namespace strake::sheets
