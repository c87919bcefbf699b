// SPDX-License-Identifier: Apache-2.0
// Lines of an object found by their place on paper.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "drawing/collinear/collinear_overlaps.hpp"

namespace strake::drawing {

/// A grid of square cells over a plane.
class LineGrid {
 public:
  /// Makes a grid over all lines; a cell is no smaller than `least`.
  LineGrid(std::span<const PlaneSegment> lines, double least) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    double right = -kFar, top = -kFar;
    left_ = bottom_ = kFar;
    for (const PlaneSegment& f : lines) {
      left_ = std::min({left_, f.ax, f.bx});
      right = std::max({right, f.ax, f.bx});
      bottom_ = std::min({bottom_, f.ay, f.by});
      top = std::max({top, f.ay, f.by});
    }
    const double width = std::max(0.0, right - left_), height = std::max(0.0, top - bottom_);
    const double count = 1 + static_cast<double>(lines.size());
    size_ = std::max({least, std::sqrt(width * height / count), (width + height) / count});
    columns_ = 1 + static_cast<std::size_t>(width / size_);
    rows_ = 1 + static_cast<std::size_t>(height / size_);
  }

  [[nodiscard]] std::size_t count() const { return columns_ * rows_; }

  /// Calls visit(cell) for the cells that have a point within `reach` of a line, and maybe for
  /// others beside it.
  template <class Visit>
  void along(const PlaneSegment& line, double reach, Visit&& visit) const {
    // The margin is far more than rounding.
    const double margin = reach + size_ * 1e-6;
    const bool turned = line.bx < line.ax;
    const double ax = turned ? line.bx : line.ax, ay = turned ? line.by : line.ay;
    const double bx = turned ? line.ax : line.bx, by = turned ? line.ay : line.by;
    const std::size_t last = cell(bx + margin - left_, columns_);
    for (std::size_t column = cell(ax - margin - left_, columns_); column <= last; ++column) {
      const double from = left_ + static_cast<double>(column) * size_;
      const double y0 = height_at(ax, ay, bx, by, from - margin);
      const double y1 = height_at(ax, ay, bx, by, from + size_ + margin);
      const std::size_t top = cell(std::max(y0, y1) + margin - bottom_, rows_);
      for (std::size_t row = cell(std::min(y0, y1) - margin - bottom_, rows_); row <= top; ++row)
        visit(row * columns_ + column);
    }
  }

 private:
  [[nodiscard]] std::size_t cell(double from_edge, std::size_t n) const {
    return from_edge <= 0 ? 0 : std::min(static_cast<std::size_t>(from_edge / size_), n - 1);
  }
  /// Returns the height at x of a line that runs to the right, or at its nearest end.
  [[nodiscard]] static double height_at(double ax, double ay, double bx, double by, double x) {
    if (x <= ax) return ay;
    if (x >= bx) return by;
    return ay + (by - ay) * ((x - ax) / (bx - ax));
  }

  double left_ = 0, bottom_ = 0, size_ = 1;
  std::size_t columns_ = 1, rows_ = 1;
};

/// Segments that are drawn already, found by place.
class LaidLines {
 public:
  LaidLines(const LineGrid& cells, const OverlapRule& rule)
      : cells_(cells), rule_(rule), first_(cells.count(), kNone) {}

  void add(const PlaneSegment& segment) {
    const auto number = static_cast<std::uint32_t>(segments_.size());
    segments_.push_back(segment);
    last_query_.push_back(kNone);
    cells_.along(segment, 0, [&](std::size_t cell) {
      entries_.push_back({number, first_[cell]});
      first_[cell] = static_cast<std::uint32_t>(entries_.size() - 1);
    });
    reach_ = std::max(reach_, segment.reach);
  }

  /// Calls visit(number) for the segments, counted as they were added, that may lie beside a line,
  /// each once and of no cell more than the last `limit`, until it returns false. Each query has
  /// another number.
  template <class Visit>
  void near(const PlaneSegment& line, std::uint32_t query, std::size_t limit, Visit&& visit) {
    bool goes_on = true;
    cells_.along(line, line.reach + reach_, [&](std::size_t cell) {
      std::size_t visited = 0;
      for (std::uint32_t e = first_[cell]; e != kNone && goes_on && visited < limit;
           e = entries_[e].next, ++visited) {
        const std::uint32_t number = entries_[e].segment;
        if (last_query_[number] == query) continue;
        last_query_[number] = query;
        goes_on = visit(number);
      }
    });
  }

  /// Appends the intervals of a line that run along those that are drawn already, of no cell more
  /// than the last `limit`.
  void find(const PlaneSegment& line, std::uint32_t query, std::vector<ParamInterval>& covers,
            std::size_t limit = std::numeric_limits<std::size_t>::max()) {
    near(line, query, limit, [&](std::uint32_t number) {
      if (const auto interval = covered(line, segments_[number], rule_))
        covers.push_back(*interval);
      return true;
    });
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  struct LaidEntry {
    std::uint32_t segment = 0, next = kNone;
  };

  const LineGrid& cells_;
  const OverlapRule& rule_;
  double reach_ = 0;
  std::vector<PlaneSegment> segments_;
  std::vector<std::uint32_t> last_query_;  ///< by segment: the last query that met it
  std::vector<std::uint32_t> first_;       ///< by cell: the last of its entries
  std::vector<LaidEntry> entries_;
};

/// How lines are laid down beside each other.
struct LayingRule {
  OverlapRule overlap;
  double whole_below = 0;  ///< lines shorter than this are dropped or kept as a whole
  double touch = 0;        ///< lengths that differ by no more are equal
};

[[nodiscard]] PlaneSegment part_of(const PlaneSegment& flat, double from, double to);

/// Appends the intervals of a line that stay where `covers` are left out. Crumbs of the many short
/// lines that make a circle would be meaningless, so such a line is dropped or kept as a whole.
void append_kept(const PlaneSegment& flat, std::uint32_t number, std::span<ParamInterval> covers,
                 const LayingRule& rule, LineIntervals& out);

}  // namespace strake::drawing
