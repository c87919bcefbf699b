// SPDX-License-Identifier: Apache-2.0
#include "drawing/ink/hidden_ink.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>

namespace strake::drawing {

namespace {

/// A grid of square cells over a plane.
class LineGrid {
 public:
  /// Makes a grid over all lines; a cell is no smaller than `least`.
  LineGrid(std::span<const HiddenLine> lines, double least) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    double right = -kFar, top = -kFar;
    left_ = bottom_ = kFar;
    for (const HiddenLine& line : lines) {
      const PlaneSegment& f = line.flat;
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

/// Intervals that have ink, found by place.
class LaidLines {
 public:
  LaidLines(const LineGrid& cells, const OverlapRule& rule)
      : cells_(cells), rule_(rule), first_(cells.count(), kNone) {}

  void add(const PlaneSegment& flat) {
    const auto number = static_cast<std::uint32_t>(segments_.size());
    segments_.push_back(flat);
    last_query_.push_back(kNone);
    cells_.along(flat, 0, [&](std::size_t cell) {
      entries_.push_back({number, first_[cell]});
      first_[cell] = static_cast<std::uint32_t>(entries_.size() - 1);
    });
    reach_ = std::max(reach_, flat.reach);
  }

  /// Appends the intervals of a line that run along inked ones. Each query has another number.
  void find(const HiddenLine& line, std::uint32_t query, std::vector<ParamInterval>& covers) {
    cells_.along(line.flat, line.flat.reach + reach_, [&](std::size_t cell) {
      for (std::uint32_t e = first_[cell]; e != kNone; e = entries_[e].next) {
        const std::uint32_t number = entries_[e].stretch;
        if (last_query_[number] == query) continue;
        last_query_[number] = query;
        if (const auto interval = covered(line.flat, segments_[number], rule_))
          covers.push_back(*interval);
      }
    });
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  struct LaidEntry {
    std::uint32_t stretch = 0, next = kNone;
  };

  const LineGrid& cells_;
  const OverlapRule& rule_;
  double reach_ = 0;
  std::vector<PlaneSegment> segments_;
  std::vector<std::uint32_t> last_query_;  ///< by entry: the last query that met it
  std::vector<std::uint32_t> first_;       ///< by cell: the last of its entries
  std::vector<LaidEntry> entries_;
};

PlaneSegment part_of(const PlaneSegment& flat, double from, double to) {
  PlaneSegment part = flat;
  const double dx = flat.bx - flat.ax, dy = flat.by - flat.ay;
  if (from > 0) {
    part.ax = flat.ax + dx * from;
    part.ay = flat.ay + dy * from;
  }
  if (to < 1) {
    part.bx = flat.ax + dx * to;
    part.by = flat.ay + dy * to;
  }
  return part;
}

/// Appends the intervals of a line that stay. Crumbs of the many short lines that make a circle
/// would be meaningless, so such a line is dropped or kept as a whole.
void cut(const HiddenLine& line, std::span<ParamInterval> covers, const HiddenInkRule& rule,
         LineIntervals& out) {
  const std::size_t first = out.size();
  const double length = line.flat.length();
  append_intervals(out, line.number, covers, rule.overlap.shortest / length);
  if (length < rule.whole_below) {
    double share = 0;
    for (std::size_t i = first; i < out.size(); ++i)
      if (out[i].covered) share += out[i].to - out[i].from;
    out.resize(first);
    if (share * length <= length / 2 + rule.touch) out.push_back({line.number, false, 0, 1});
    return;
  }
  const auto begin = out.begin() + static_cast<std::ptrdiff_t>(first);
  out.erase(std::remove_if(begin, out.end(), [](const LineInterval& s) { return s.covered; }),
            out.end());
}

}  // namespace

void choose_hidden_lines(std::vector<HiddenLine>& lines, const HiddenInkRule& rule,
                         const std::stop_token& stop, LineIntervals& out) {
  if (lines.empty()) return;
  std::ranges::sort(lines, {},
                    [](const HiddenLine& line) { return std::pair(-line.order, line.number); });
  double reach = 0;
  for (const HiddenLine& line : lines) reach = std::max(reach, line.flat.reach);
  // Cells are so wide that a query, which is widened by the reach, visits few of them.
  const LineGrid cells(lines, 16 * reach);
  LaidLines laid(cells, rule.overlap);
  const std::size_t begin = out.size();
  constexpr std::size_t kUnasked = 1024;  // lines between two checks whether to stop
  for (std::uint32_t i = 0; i < lines.size(); ++i) {
    if (i % kUnasked == 0 && stop.stop_requested()) return;
    HiddenLine& line = lines[i];
    laid.find(line, i, line.covers);
    const std::size_t first = out.size();
    cut(line, line.covers, rule, out);
    for (std::size_t k = first; k < out.size(); ++k)
      laid.add(part_of(line.flat, out[k].from, out[k].to));
  }
  std::sort(out.begin() + static_cast<std::ptrdiff_t>(begin), out.end(),
            [](const LineInterval& a, const LineInterval& b) {
              return std::tie(a.line, a.from) < std::tie(b.line, b.from);
            });
}

}  // namespace strake::drawing
