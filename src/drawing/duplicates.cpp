// SPDX-License-Identifier: Apache-2.0
#include "drawing/duplicates.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "drawing/paper.hpp"

namespace strake::drawing {

namespace {

using geometry::Vec3d;

struct Interval {
  double from, to;  ///< parameter along a line, 0 at a, 1 at b
};

double length_of(const Line& line) {
  const double dx = line.b_paper.x - line.a_paper.x, dy = line.b_paper.y - line.a_paper.y;
  return std::sqrt(dx * dx + dy * dy);
}

bool is_drawn(const Line& line) {
  return line.state == LineState::visible || line.state == LineState::hidden_by_self ||
         line.state == LineState::hidden_by_other;
}

/// A grid over the sheet; each cell lists the lines that pass through or near it.
class CellGrid {
 public:
  explicit CellGrid(const std::vector<Line>& lines);

  /// Calls visit(other) for every line that shares a cell with `line`; some more than once.
  template <class Visit>
  void neighbours(const Line& line, Visit&& visit) const {
    walk(line, [&](std::size_t cell) {
      for (std::size_t k = first_[cell]; k < first_[cell + 1]; ++k) visit(items_[k]);
    });
  }

 private:
  template <class Visit>
  void walk(const Line& line, Visit&& visit) const;
  [[nodiscard]] std::size_t cell_of(double at, double low, std::size_t count) const {
    const double cell = std::floor((at - low) / size_);
    return cell <= 0 ? 0 : std::min(static_cast<std::size_t>(cell), count - 1);
  }

  double left_ = 0, top_ = 0, size_ = 1;
  std::size_t columns_ = 1, rows_ = 1;
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> items_;
};

CellGrid::CellGrid(const std::vector<Line>& lines) {
  constexpr double kBig = std::numeric_limits<double>::max();
  double right = -kBig, bottom = -kBig, total = 0;
  left_ = top_ = kBig;
  std::size_t drawn = 0;
  for (const Line& line : lines) {
    if (!is_drawn(line)) continue;
    ++drawn;
    total += length_of(line);
    for (const PaperPoint& p : {line.a_paper, line.b_paper}) {
      left_ = std::min(left_, p.x);
      right = std::max(right, p.x);
      top_ = std::min(top_, p.y);
      bottom = std::max(bottom, p.y);
    }
  }
  if (drawn == 0) {
    left_ = top_ = right = bottom = 0;
  }
  // About the mean length: a line is then in few cells, and a cell has few lines.
  const double mean = drawn > 0 ? total / static_cast<double>(drawn) : 1;
  const double widest = std::max({right - left_, bottom - top_, 1.0});
  size_ = std::max({mean, widest / 2048, 0.1});
  columns_ = static_cast<std::size_t>((right - left_) / size_) + 1;
  rows_ = static_cast<std::size_t>((bottom - top_) / size_) + 1;
  first_.assign(columns_ * rows_ + 1, 0);
  for (const Line& line : lines)
    if (is_drawn(line)) walk(line, [&](std::size_t cell) { ++first_[cell + 1]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  items_.resize(first_.back());
  std::vector<std::size_t> at(first_.begin(), first_.end() - 1);
  for (std::uint32_t i = 0; i < lines.size(); ++i)
    if (is_drawn(lines[i])) walk(lines[i], [&](std::size_t cell) { items_[at[cell]++] = i; });
}

/// Visits, column by column, the cells of the rows that the line spans in that column, widened by
/// the duplicate distance so that two lines that lie on each other always share a cell.
template <class Visit>
void CellGrid::walk(const Line& line, Visit&& visit) const {
  const PaperPoint& a = line.a_paper.x <= line.b_paper.x ? line.a_paper : line.b_paper;
  const PaperPoint& b = line.a_paper.x <= line.b_paper.x ? line.b_paper : line.a_paper;
  const double slack = 2 * kDuplicateDistance;
  const std::size_t from = cell_of(a.x - slack, left_, columns_);
  const std::size_t to = cell_of(b.x + slack, left_, columns_);
  const double dx = b.x - a.x, dy = b.y - a.y;
  const auto y_at = [&](double x) {
    return dx > 0 ? a.y + dy * std::clamp((x - a.x) / dx, 0.0, 1.0) : a.y;
  };
  for (std::size_t column = from; column <= to; ++column) {
    const double x0 = left_ + static_cast<double>(column) * size_ - slack;
    const double y0 = dx > 0 ? y_at(x0) : a.y, y1 = dx > 0 ? y_at(x0 + size_ + 2 * slack) : b.y;
    const std::size_t low = cell_of(std::min(y0, y1) - slack, top_, rows_);
    const std::size_t high = cell_of(std::max(y0, y1) + slack, top_, rows_);
    for (std::size_t row = low; row <= high; ++row) visit(row * columns_ + column);
  }
}

/// The stretch of `line` that `other` lies on, when the two coincide there within the distance.
std::optional<Interval> covered(const Line& line, const Line& other) {
  const double length = length_of(line);
  const double dx = (line.b_paper.x - line.a_paper.x) / length;
  const double dy = (line.b_paper.y - line.a_paper.y) / length;
  const auto along = [&](const PaperPoint& p) {
    return (p.x - line.a_paper.x) * dx + (p.y - line.a_paper.y) * dy;
  };
  const auto aside = [&](const PaperPoint& p) {
    return (p.y - line.a_paper.y) * dx - (p.x - line.a_paper.x) * dy;
  };
  double s0 = along(other.a_paper), s1 = along(other.b_paper);
  double d0 = aside(other.a_paper), d1 = aside(other.b_paper);
  if (s0 > s1) {
    std::swap(s0, s1);
    std::swap(d0, d1);
  }
  const double from = std::max(0.0, s0), to = std::min(length, s1);
  if (to - from <= kDuplicateDistance) return std::nullopt;
  // The other line's distance at both ends of the common stretch.
  const double slope = (d1 - d0) / (s1 - s0);
  if (std::fabs(d0 + slope * (from - s0)) > kDuplicateDistance ||
      std::fabs(d0 + slope * (to - s0)) > kDuplicateDistance)
    return std::nullopt;
  return Interval{from / length, to / length};
}

/// Who stays when two lines coincide: smaller first.
struct Rank {
  int state;
  double depth;  ///< smaller is nearer
  std::uint32_t index;
  friend bool operator<(const Rank& a, const Rank& b) {
    return std::tie(a.state, a.depth, a.index) < std::tie(b.state, b.depth, b.index);
  }
};

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

/// Cuts a line at its covered intervals. Stretches too short to be seen go with their neighbour.
void append_parts(std::vector<Line>& out, const Line& line, std::vector<Interval>& covers) {
  std::sort(covers.begin(), covers.end(), [](const Interval& a, const Interval& b) {
    return std::tie(a.from, a.to) < std::tie(b.from, b.to);
  });
  const double shortest = kDuplicateDistance / length_of(line);
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

std::vector<Line> mark_duplicates(std::vector<Line> lines, const Vec3d& toward) {
  const CellGrid grid(lines);
  std::vector<Rank> ranks;
  ranks.reserve(lines.size());
  for (std::uint32_t i = 0; i < lines.size(); ++i) {
    const Line& line = lines[i];
    const double depth = -(dot(toward, line.a_mm) + dot(toward, line.b_mm));
    ranks.push_back({line.state == LineState::visible ? 0 : 1, depth, i});
  }
  std::vector<Line> out;
  out.reserve(lines.size() + lines.size() / 8);
  std::vector<Interval> covers;
  for (std::uint32_t i = 0; i < lines.size(); ++i) {
    covers.clear();
    if (is_drawn(lines[i]) && length_of(lines[i]) > kDuplicateDistance)
      grid.neighbours(lines[i], [&](std::uint32_t other) {
        if (other == i || !(ranks[other] < ranks[i])) return;
        if (const auto interval = covered(lines[i], lines[other])) covers.push_back(*interval);
      });
    if (covers.empty())
      out.push_back(lines[i]);
    else
      append_parts(out, lines[i], covers);
  }
  return out;
}

}  // namespace strake::drawing
