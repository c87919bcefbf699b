// SPDX-License-Identifier: Apache-2.0
#include "strake/drawing/ink.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "drawing/duplicates.hpp"
#include "drawing/overlaps.hpp"
#include "drawing/pens.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::drawing {

namespace {

using geometry::Vec3d;
using geometry::Vec3l;

/// Length of lines per area of paper, in squares.
class Density {
 public:
  explicit Density(const Sheet& sheet)
      : size_(std::max(4.0, std::sqrt(sheet.width_mm * sheet.height_mm) / 500)),
        columns_(count(sheet.width_mm)),
        rows_(count(sheet.height_mm)),
        length_(columns_ * rows_) {}

  void add(const Line& line) {
    const double dx = line.b_paper.x - line.a_paper.x, dy = line.b_paper.y - line.a_paper.y;
    const double length = std::sqrt(dx * dx + dy * dy);
    const double steps = std::ceil(length * 2 / size_);
    for (double i = 0; i < steps; ++i) {
      const double t = (i + 0.5) / steps;
      length_[index(line.a_paper.y + dy * t, rows_) * columns_ +
              index(line.a_paper.x + dx * t, columns_)] += length / steps;
    }
  }

  /// As a reader's eye meets it, line by line: per mm of paper, averaged over the lines.
  [[nodiscard]] double along_lines() const {
    double sum = 0, squares = 0;
    for (const double length : length_) {
      sum += length;
      squares += length * length;
    }
    return sum > 0 ? squares / sum / (size_ * size_) : 0;
  }

 private:
  [[nodiscard]] std::size_t count(double mm) const {
    return static_cast<std::size_t>(std::max(1.0, std::ceil(mm / size_)));
  }
  [[nodiscard]] std::size_t index(double mm, std::size_t n) const {
    const double cell = std::floor(mm / size_);
    return cell <= 0 ? 0 : std::min(static_cast<std::size_t>(cell), n - 1);
  }

  double size_;
  std::size_t columns_, rows_;
  std::vector<double> length_;
};

double width_of(const Line& line, const Pens& pens) {
  if (line.state != LineState::visible || line.kind == hlr::EdgeKind::polyline ||
      line.kind == hlr::EdgeKind::hatch || line.kind == hlr::EdgeKind::smooth)
    return pens.thin;
  if (line.kind == hlr::EdgeKind::section) return pens.section;
  return line.kind == hlr::EdgeKind::contour ? pens.outline : pens.edge;
}

/// Dashed hatching would say that a hidden face is cut, and a smooth edge is worth a hint only.
bool may_be_dashed(const Line& line) {
  return is_hidden(line.state) && line.kind != hlr::EdgeKind::hatch &&
         line.kind != hlr::EdgeKind::smooth;
}

Vec3l on_grid(const Vec3d& mm) { return geometry::snap(mm).value_or(Vec3l{}); }

std::vector<Flat> flatten(const std::vector<Line>& lines, const Vec3l& direction,
                          const Pens& pens) {
  std::vector<Flat> flat(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Line& line = lines[i];
    Flat& f = flat[i];
    f = {.ax = line.a_paper.x, .ay = line.a_paper.y, .bx = line.b_paper.x, .by = line.b_paper.y};
    f.depth = nearness(direction, on_grid(line.a_mm), on_grid(line.b_mm));
    f.reach = width_of(line, pens) / 2;
    if (f.length() > 0) f.rank = is_hidden(line.state) ? Rank::hidden : Rank::visible;
  }
  return flat;
}

/// Appends what is kept of a line. One shorter than a dash goes or stays as a whole: crumbs of the
/// many short lines that make a circle would say nothing.
void keep(const Line& line, const PaperAxes& axes, std::span<const Stretch> stretches, double dash,
          Ink& ink) {
  double covered = 0;
  for (const Stretch& s : stretches)
    if (s.covered) covered += s.to - s.from;
  const double dx = line.b_paper.x - line.a_paper.x, dy = line.b_paper.y - line.a_paper.y;
  const bool whole = dx * dx + dy * dy < dash * dash;
  if (covered > (whole ? 0.5 : 0)) ++ink.left_out;
  if (whole && covered <= 0.5) ink.lines.push_back(line);
  if (whole) return;
  for (const Stretch& s : stretches)
    if (!s.covered) ink.lines.push_back(part_of(line, axes, s.from, s.to));
}

Status clean_up(Ink& ink, const Vec3l& direction, const PaperAxes& axes,
                const parallel::Context& context) {
  // Lines that cross, or of which one begins on the other, do not run along each other.
  const double thin = ink.pens.thin;
  const OverlapRule rule{
      .least = 1e-3, .greatest_sine = 0.2, .covers_visible = false, .shortest = kDashGap * thin};
  const auto found = cut_overlaps(flatten(ink.lines, direction, ink.pens), rule, context);
  if (!found) return found.error();
  const std::vector<Line> lines = std::exchange(ink.lines, {});
  ink.lines.reserve(lines.size());
  const std::span<const Stretch> stretches = found->stretches;
  std::size_t first = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (found->wholly.is_set(i)) {
      ++ink.left_out;
      continue;
    }
    std::size_t end = first;
    while (end < stretches.size() && stretches[end].line == i) ++end;
    if (end == first)
      ink.lines.push_back(lines[i]);
    else
      keep(lines[i], axes, stretches.subspan(first, end - first), kDash * thin, ink);
    first = end;
  }
  return {};
}

}  // namespace

Pens choose_pens(const NeutralDrawing& drawing) {
  Density density(drawing.sheet);
  for (const Line& line : drawing.lines)
    if (line.state == LineState::visible && line.kind != hlr::EdgeKind::hatch) density.add(line);
  // The share of paper that the middle pen of each group may blacken at most.
  constexpr double kMost = 0.35;
  const double per_mm = density.along_lines();
  for (const Pens& pens :
       {Pens{0.5, 0.35, 0.25, 0.7}, Pens{0.35, 0.25, 0.18, 0.5}, Pens{0.25, 0.18, 0.13, 0.35}})
    if (per_mm * pens.edge <= kMost) return pens;
  return {0.18, 0.13, 0.09, 0.25};
}

Result<Ink> choose_ink(const NeutralDrawing& drawing, const InkOptions& options,
                       const parallel::Context& context) {
  Ink ink{.pens = options.pens ? *options.pens : choose_pens(drawing), .lines = {}};
  for (const Line& line : drawing.lines)
    if (line.state == LineState::visible || (options.hidden && may_be_dashed(line)))
      ink.lines.push_back(line);
  const auto axes = paper_axes(drawing.view);
  if (options.hidden && options.clean_up && axes)
    if (const Status status = clean_up(ink, drawing.view.direction, *axes, context); !status)
      return status.error();
  return ink;
}

}  // namespace strake::drawing
