// SPDX-License-Identifier: Apache-2.0
#include "drawing/duplicates.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "drawing/paper.hpp"

namespace strake::drawing {

namespace {

using geometry::Vec3d;

struct Interval {
  double from, to;  ///< parameter along a line, 0 at a, 1 at b
};

/// A line in the plane of the view, model millimetres.
struct Flat {
  double ax = 0, ay = 0, bx = 0, by = 0;
  double dx = 0, dy = 0, length = 0;  ///< unit direction from a to b
  double depth = 0;                   ///< of the two ends together; larger is nearer
  int state = 0;                      ///< 0 visible, 1 hidden, 2 takes no part
};

int state_rank(LineState state) {
  if (state == LineState::visible) return 0;
  return state == LineState::hidden_by_self || state == LineState::hidden_by_other ? 1 : 2;
}

std::vector<Flat> flatten(const std::vector<Line>& lines, const PaperAxes& axes) {
  std::vector<Flat> flat(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    // Relative to the first line: far from the origin differences keep their digits.
    const Vec3d a = lines[i].a_mm - lines[0].a_mm, b = lines[i].b_mm - lines[0].a_mm;
    Flat& f = flat[i];
    f.ax = dot(axes.right, a);
    f.ay = dot(axes.up, a);
    f.bx = dot(axes.right, b);
    f.by = dot(axes.up, b);
    const double dx = f.bx - f.ax, dy = f.by - f.ay;
    f.length = std::sqrt(dx * dx + dy * dy);
    f.depth = dot(axes.toward, a) + dot(axes.toward, b);
    f.state = f.length > 0 ? state_rank(lines[i].state) : 2;
    if (f.length > 0) {
      f.dx = dx / f.length;
      f.dy = dy / f.length;
    }
  }
  return flat;
}

/// A grid over the view; each cell lists the lines that pass through or near it.
class CellGrid {
 public:
  CellGrid(const std::vector<Flat>& lines, double slack);

  /// Calls visit(other) for every line that shares a cell with `line`; some more than once.
  template <class Visit>
  void neighbours(const Flat& line, Visit&& visit) const {
    walk(line, [&](std::size_t cell) {
      for (std::size_t k = first_[cell]; k < first_[cell + 1]; ++k) visit(items_[k]);
    });
  }

 private:
  template <class Visit>
  void walk(const Flat& line, Visit&& visit) const;
  void measure(const std::vector<Flat>& lines);
  [[nodiscard]] std::size_t cell_of(double at, double low, std::size_t count) const {
    const double cell = std::floor((at - low) / size_);
    return cell <= 0 ? 0 : std::min(static_cast<std::size_t>(cell), count - 1);
  }

  double slack_, left_ = 0, top_ = 0, size_ = 1;
  std::size_t columns_ = 1, rows_ = 1;
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> items_;
};

/// Cells of about half the mean length, so that a line is in few cells and a cell has few lines;
/// at most 2048 of them along a side.
void CellGrid::measure(const std::vector<Flat>& lines) {
  constexpr double kBig = std::numeric_limits<double>::max();
  double left = kBig, right = -kBig, top = kBig, bottom = -kBig, total = 0;
  std::size_t drawn = 0;
  for (const Flat& line : lines) {
    if (line.state == 2) continue;
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
  size_ = std::max({total / static_cast<double>(drawn) / 2, widest / 2048, 4 * slack_, 1e-3});
  columns_ = static_cast<std::size_t>((right - left) / size_) + 1;
  rows_ = static_cast<std::size_t>((bottom - top) / size_) + 1;
}

CellGrid::CellGrid(const std::vector<Flat>& lines, double slack) : slack_(slack) {
  measure(lines);
  first_.assign(columns_ * rows_ + 1, 0);
  for (const Flat& line : lines)
    if (line.state < 2) walk(line, [&](std::size_t cell) { ++first_[cell + 1]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  items_.resize(first_.back());
  std::vector<std::size_t> at(first_.begin(), first_.end() - 1);
  for (std::uint32_t i = 0; i < lines.size(); ++i)
    if (lines[i].state < 2) walk(lines[i], [&](std::size_t cell) { items_[at[cell]++] = i; });
}

/// Visits, column by column, the cells of the rows that the line spans in that column, widened by
/// the slack so that two lines that lie on each other always share a cell.
template <class Visit>
void CellGrid::walk(const Flat& line, Visit&& visit) const {
  const bool forward = line.ax <= line.bx;
  const double ax = forward ? line.ax : line.bx, ay = forward ? line.ay : line.by;
  const double bx = forward ? line.bx : line.ax, by = forward ? line.by : line.ay;
  const std::size_t from = cell_of(ax - slack_, left_, columns_);
  const std::size_t to = cell_of(bx + slack_, left_, columns_);
  for (std::size_t column = from; column <= to; ++column) {
    double y0 = ay, y1 = by;
    if (from != to && bx > ax) {
      const double x0 = left_ + static_cast<double>(column) * size_;
      y0 = ay + (by - ay) * std::clamp((x0 - slack_ - ax) / (bx - ax), 0.0, 1.0);
      y1 = ay + (by - ay) * std::clamp((x0 + size_ + slack_ - ax) / (bx - ax), 0.0, 1.0);
    }
    const std::size_t low = cell_of(std::min(y0, y1) - slack_, top_, rows_);
    const std::size_t high = cell_of(std::max(y0, y1) + slack_, top_, rows_);
    for (std::size_t row = low; row <= high; ++row) visit(row * columns_ + column);
  }
}

/// The stretch of `line` that `other` lies on, when the two coincide there within the distance.
std::optional<Interval> covered(const Flat& line, const Flat& other, double distance) {
  double d0 = (other.ay - line.ay) * line.dx - (other.ax - line.ax) * line.dy;
  double d1 = (other.by - line.ay) * line.dx - (other.bx - line.ax) * line.dy;
  if (std::min(d0, d1) > distance || std::max(d0, d1) < -distance) return std::nullopt;
  double s0 = (other.ax - line.ax) * line.dx + (other.ay - line.ay) * line.dy;
  double s1 = (other.bx - line.ax) * line.dx + (other.by - line.ay) * line.dy;
  if (s0 > s1) {
    std::swap(s0, s1);
    std::swap(d0, d1);
  }
  const double from = std::max(0.0, s0), to = std::min(line.length, s1);
  if (to - from <= distance) return std::nullopt;
  // The other line's distance at both ends of the common stretch.
  const double slope = (d1 - d0) / (s1 - s0);
  if (std::fabs(d0 + slope * (from - s0)) > distance ||
      std::fabs(d0 + slope * (to - s0)) > distance)
    return std::nullopt;
  return Interval{from / line.length, to / line.length};
}

/// Whether line i stays where both i and j are: a total order.
bool stays(const std::vector<Flat>& flat, std::uint32_t i, std::uint32_t j) {
  return std::tuple(flat[i].state, -flat[i].depth, i) <
         std::tuple(flat[j].state, -flat[j].depth, j);
}

PaperPoint between(const PaperPoint& a, const PaperPoint& b, double t) {
  return {rounded_paper(a.x + (b.x - a.x) * t), rounded_paper(a.y + (b.y - a.y) * t)};
}

Line part_of(const Line& line, double from, double to, bool duplicate) {
  Line part = line;
  const auto at = [&](double t) {
    return Vec3d{line.a_mm.x + (line.b_mm.x - line.a_mm.x) * t,
                 line.a_mm.y + (line.b_mm.y - line.a_mm.y) * t,
                 line.a_mm.z + (line.b_mm.z - line.a_mm.z) * t};
  };
  if (from > 0) {
    part.a_mm = at(from);
    part.a_paper = between(line.a_paper, line.b_paper, from);
  }
  if (to < 1) {
    part.b_mm = at(to);
    part.b_paper = between(line.a_paper, line.b_paper, to);
  }
  if (duplicate) part.state = LineState::duplicate;
  return part;
}

/// Cuts a line at its covered intervals. Stretches no longer than `shortest` (a parameter) go with
/// their neighbour.
void append_parts(std::vector<Line>& out, const Line& line, std::vector<Interval>& covers,
                  double shortest) {
  std::sort(covers.begin(), covers.end(), [](const Interval& a, const Interval& b) {
    return std::tie(a.from, a.to) < std::tie(b.from, b.to);
  });
  double done = 0;
  for (std::size_t i = 0; i < covers.size();) {
    double from = covers[i].from, to = covers[i].to;
    for (++i; i < covers.size() && covers[i].from <= to + shortest; ++i)
      to = std::max(to, covers[i].to);
    if (from - done <= shortest) from = done;
    if (1 - to <= shortest) to = 1;
    if (from > done) out.push_back(part_of(line, done, from, false));
    out.push_back(part_of(line, from, to, true));
    done = to;
  }
  if (done < 1) out.push_back(part_of(line, done, 1, false));
}

}  // namespace

std::vector<Line> mark_duplicates(std::vector<Line> lines, const PaperAxes& axes,
                                  double distance_mm) {
  const std::vector<Flat> flat = flatten(lines, axes);
  const CellGrid grid(flat, 2 * distance_mm);
  std::vector<Line> out;
  out.reserve(lines.size() + lines.size() / 8);
  std::vector<Interval> covers;
  for (std::uint32_t i = 0; i < lines.size(); ++i) {
    covers.clear();
    if (flat[i].state < 2 && flat[i].length > distance_mm)
      grid.neighbours(flat[i], [&](std::uint32_t other) {
        if (other == i || !stays(flat, other, i)) return;
        if (const auto interval = covered(flat[i], flat[other], distance_mm))
          covers.push_back(*interval);
      });
    if (covers.empty())
      out.push_back(lines[i]);
    else
      append_parts(out, lines[i], covers, distance_mm / flat[i].length);
  }
  return out;
}

}  // namespace strake::drawing
