// SPDX-License-Identifier: Apache-2.0
#include "drawing/overlaps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "strake/parallel/collect.hpp"

namespace strake::drawing {

namespace {

struct Interval {
  double from, to;
};

/// A grid over the view; each cell lists the lines that pass through it.
class CellGrid {
 public:
  CellGrid(std::span<const Flat> lines, double slack);

  /// Calls visit(other) for every line that shares a cell with `line`, some more than once, until
  /// it returns false.
  template <class Visit>
  void neighbours(const Flat& line, Visit&& visit) const {
    walk(line, slack_, [&](std::size_t cell) {
      for (std::size_t k = first_[cell]; k < first_[cell + 1]; ++k)
        if (!visit(items_[k])) return false;
      return true;
    });
  }

 private:
  template <class Visit>
  void walk(const Flat& line, double slack, Visit&& visit) const;
  void measure(std::span<const Flat> lines);
  [[nodiscard]] std::size_t cell_of(double at, double low, std::size_t count) const {
    const double cell = std::floor((at - low) / size_);
    return cell <= 0 ? 0 : std::min(static_cast<std::size_t>(cell), count - 1);
  }

  static constexpr double kRounding = 1e-3;
  double slack_, left_ = 0, top_ = 0, size_ = 1;
  std::size_t columns_ = 1, rows_ = 1;
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> items_;
};

/// Cells of about half the mean length, so that a line is in few cells and a cell has few lines;
/// at most 2048 of them along a side.
void CellGrid::measure(std::span<const Flat> lines) {
  constexpr double kBig = std::numeric_limits<double>::max();
  double left = kBig, right = -kBig, top = kBig, bottom = -kBig, total = 0;
  std::size_t drawn = 0;
  for (const Flat& line : lines) {
    if (line.rank == Rank::none) continue;
    ++drawn;
    total += line.length;
    left = std::min({left, line.ax, line.bx});
    right = std::max({right, line.ax, line.bx});
    top = std::min({top, line.ay, line.by});
    bottom = std::max({bottom, line.ay, line.by});
  }
  if (drawn == 0) return;
  left_ = left;
  top_ = top;
  const double widest = std::max(right - left, bottom - top);
  size_ = std::max({total / static_cast<double>(drawn) / 2, widest / 2048, 2 * slack_, 1e-3});
  columns_ = static_cast<std::size_t>((right - left) / size_) + 1;
  rows_ = static_cast<std::size_t>((bottom - top) / size_) + 1;
}

CellGrid::CellGrid(std::span<const Flat> lines, double slack) : slack_(slack) {
  measure(lines);
  first_.assign(columns_ * rows_ + 1, 0);
  for (const Flat& line : lines)
    if (line.rank != Rank::none)
      walk(line, kRounding * slack_, [&](std::size_t cell) { return ++first_[cell + 1] > 0; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  items_.resize(first_.back());
  std::vector<std::size_t> at(first_.begin(), first_.end() - 1);
  for (std::uint32_t i = 0; i < lines.size(); ++i)
    if (lines[i].rank != Rank::none)
      walk(lines[i], kRounding * slack_, [&](std::size_t cell) {
        items_[at[cell]++] = i;
        return true;
      });
}

/// Visits, column by column, the cells of the rows that the line spans in that column, widened by
/// the slack: what is nearer than that to the line passes through one of them.
template <class Visit>
void CellGrid::walk(const Flat& line, double slack, Visit&& visit) const {
  const bool forward = line.ax <= line.bx;
  const double ax = forward ? line.ax : line.bx, ay = forward ? line.ay : line.by;
  const double bx = forward ? line.bx : line.ax, by = forward ? line.by : line.ay;
  const std::size_t from = cell_of(ax - slack, left_, columns_);
  const std::size_t to = cell_of(bx + slack, left_, columns_);
  for (std::size_t column = from; column <= to; ++column) {
    double y0 = ay, y1 = by;
    if (from != to && bx > ax) {
      const double x0 = left_ + static_cast<double>(column) * size_;
      y0 = ay + (by - ay) * std::clamp((x0 - slack - ax) / (bx - ax), 0.0, 1.0);
      y1 = ay + (by - ay) * std::clamp((x0 + size_ + slack - ax) / (bx - ax), 0.0, 1.0);
    }
    const std::size_t low = cell_of(std::min(y0, y1) - slack, top_, rows_);
    const std::size_t high = cell_of(std::max(y0, y1) + slack, top_, rows_);
    for (std::size_t row = low; row <= high; ++row)
      if (!visit(row * columns_ + column)) return;
  }
}

/// The stretch of `line` that `other` lies on, when the two coincide there.
std::optional<Interval> covered(const Flat& line, const Flat& other, const OverlapRule& rule) {
  const double distance = line.reach + other.reach;
  double d0 = (other.ay - line.ay) * line.dx - (other.ax - line.ax) * line.dy;
  double d1 = (other.by - line.ay) * line.dx - (other.bx - line.ax) * line.dy;
  if (std::min(d0, d1) > distance || std::max(d0, d1) < -distance) return std::nullopt;
  if (std::fabs(d1 - d0) > rule.greatest_sine * other.length) return std::nullopt;
  double s0 = (other.ax - line.ax) * line.dx + (other.ay - line.ay) * line.dy;
  double s1 = (other.bx - line.ax) * line.dx + (other.by - line.ay) * line.dy;
  if (s0 > s1) {
    std::swap(s0, s1);
    std::swap(d0, d1);
  }
  const double from = std::max(0.0, s0), to = std::min(line.length, s1);
  if (to - from <= rule.least) return std::nullopt;
  // The other line's distance at both ends of the common stretch.
  const double slope = (d1 - d0) / (s1 - s0);
  if (std::fabs(d0 + slope * (from - s0)) > distance ||
      std::fabs(d0 + slope * (to - s0)) > distance)
    return std::nullopt;
  return Interval{from / line.length, to / line.length};
}

/// Whether line i stays where both i and j are: a total order.
bool stays(std::span<const Flat> flat, std::uint32_t i, std::uint32_t j) {
  return std::tuple(flat[i].rank, -flat[i].depth, i) < std::tuple(flat[j].rank, -flat[j].depth, j);
}

/// Appends a line cut at its covered intervals. `shortest` is a parameter.
void append_stretches(std::vector<Stretch>& out, std::uint32_t line, std::vector<Interval>& covers,
                      double shortest) {
  std::sort(covers.begin(), covers.end(), [](const Interval& a, const Interval& b) {
    return std::tie(a.from, a.to) < std::tie(b.from, b.to);
  });
  double done = 0;
  for (std::size_t i = 0; i < covers.size();) {
    double from = covers[i].from, to = covers[i].to;
    for (++i; i < covers.size() && covers[i].from <= to + shortest; ++i)
      to = std::max(to, covers[i].to);
    const double least = std::min(shortest, to - from);
    if (from - done <= least) from = done;
    if (1 - to <= least) to = 1;
    if (from > done) out.push_back({line, false, done, from});
    out.push_back({line, true, from, to});
    done = to;
  }
  if (done < 1) out.push_back({line, false, done, 1});
}

}  // namespace

Flat::Flat(double from_x, double from_y, double to_x, double to_y)
    : ax(from_x), ay(from_y), bx(to_x), by(to_y) {
  const double x = bx - ax, y = by - ay;
  length = std::sqrt(x * x + y * y);
  if (!(length > 0)) return;
  dx = x / length;
  dy = y / length;
}

Result<std::vector<Stretch>> cut_overlaps(std::span<const Flat> lines, const OverlapRule& rule,
                                          const parallel::Context& context) {
  double reach = 0;
  for (const Flat& line : lines) reach = std::max(reach, line.reach);
  const CellGrid grid(lines, 2 * reach);
  return parallel::collect_with<Stretch>(
      context, {.name = "overlapping lines", .n = lines.size(), .grain = 512},
      [] { return std::vector<Interval>{}; },
      [&](std::vector<Interval>& covers, std::size_t n, std::vector<Stretch>& out) {
        const auto i = static_cast<std::uint32_t>(n);
        const Flat& line = lines[i];
        covers.clear();
        const bool may_go =
            line.rank == Rank::hidden || (line.rank == Rank::visible && rule.covers_visible);
        if (may_go && line.length > rule.least)
          grid.neighbours(line, [&](std::uint32_t other) {
            if (other == i || !stays(lines, other, i)) return true;
            const auto interval = covered(line, lines[other], rule);
            if (!interval) return true;
            covers.push_back(*interval);
            return interval->from > 0 || interval->to < 1;
          });
        if (covers.empty())
          out.push_back({i, false, 0, 1});
        else
          append_stretches(out, i, covers, rule.shortest / line.length);
      });
}

}  // namespace strake::drawing
