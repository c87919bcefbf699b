// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// The distance between two texts, and between a text and a line.
inline constexpr double kClearanceMm = 0.7;

/// The occupied paper of a sheet, in squares of about a millimetre: whether a line runs through a
/// square, and whether a text or a bubble blocks it.
///
/// Lines and boxes are added first; then finish() is called, once; then the grid answers.
class OccupancyGrid {
 public:
  OccupancyGrid(double width_mm, double height_mm);

  void add_line(const PaperPoint& a, const PaperPoint& b);
  /// Blocks a box: no text may stand and no leader run there.
  void block(const PaperBox& box);
  void finish();

  /// Returns whether a box, which must lie on the sheet, has nothing within the clearance: no line
  /// and nothing that blocks. Takes constant time. True only if that is so; false for some boxes
  /// that are free by less than two squares.
  [[nodiscard]] bool is_free(const PaperBox& box) const;

  /// What the leader from a to b runs over, in half-square steps: those with lines, and all that
  /// were looked at. It is looked at up to the first step that is blocked.
  struct LeaderPath {
    bool open = true;
    std::size_t lines = 0, steps = 0;
  };
  [[nodiscard]] LeaderPath leader_path(const PaperPoint& a, const PaperPoint& b) const;

 private:
  enum class Occupancy : std::uint8_t { no, by_line, blocked };

  [[nodiscard]] std::size_t column(double x) const;
  [[nodiscard]] std::size_t row(double y) const;
  template <class Take>
  void walk(const PaperPoint& a, const PaperPoint& b, Take&& take) const;

  double width_mm_ = 0, height_mm_ = 0, size_ = 1;
  std::size_t columns_ = 1, rows_ = 1;
  std::vector<Occupancy> cells_;
  /// For each corner of squares the number of taken squares to the left of it and above: a
  /// summed-area table.
  std::vector<std::uint32_t> taken_before_;
};

}  // namespace strake::sheets
