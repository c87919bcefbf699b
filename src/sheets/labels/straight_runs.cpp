// SPDX-License-Identifier: Apache-2.0
#include "sheets/labels/straight_runs.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <tuple>
#include <utility>

#include "drawing/centre/axes.hpp"
#include "drawing/layout/view_plane.hpp"

namespace strake::sheets {

namespace {

using drawing::Line;

/// Lines no farther apart than this, mm, and no farther turned are in line.
constexpr double kInLine = 0.05, kSameWay = 1e-3;

/// A run by the line on which it lies.
struct RunInLine {
  std::int64_t angle = 0, offset = 0;
  double from = 0, to = 0;  ///< along the line
  StraightRun run;          ///< from left to right, or downwards
};

/// Counts cells of a width; their rims lie off the round numbers that coordinates often are.
std::int64_t cell(double value, double width) { return std::llround(value / width + 0.137); }

RunInLine in_line(StraightRun run) {
  auto& [a, b] = run.line;
  if (b.x < a.x - 1e-9 || (std::fabs(b.x - a.x) <= 1e-9 && b.y < a.y)) std::swap(a, b);
  const double length = length_of(run.line);
  const double x = (b.x - a.x) / length, y = (b.y - a.y) / length;
  const double from = a.x * x + a.y * y;
  return {cell(y, kSameWay), cell(a.y * x - a.x * y, kInLine), from, from + length, run};
}

/// Makes one run of those that lie in line and meet.
std::vector<StraightRun> joined(const std::vector<StraightRun>& runs) {
  std::vector<RunInLine> all;
  for (const StraightRun& run : runs) all.push_back(in_line(run));
  std::ranges::sort(all, {}, [](const RunInLine& r) {
    return std::tuple(r.angle, r.offset, r.from, r.to, r.run.half_mm);
  });
  std::vector<StraightRun> found;
  for (std::size_t i = 0; i < all.size();) {
    RunInLine one = all[i];
    for (++i; i < all.size() && all[i].angle == one.angle && all[i].offset == one.offset &&
              all[i].from <= one.to + kInLine;
         ++i) {
      one.run.half_mm = std::max(one.run.half_mm, all[i].run.half_mm);
      if (all[i].to <= one.to) continue;
      one.to = all[i].to;
      one.run.line.b = all[i].run.line.b;
    }
    found.push_back(one.run);
  }
  std::ranges::sort(found, {}, [](const StraightRun& run) {
    const auto& [a, b] = run.line;
    return std::tuple(-length_of(run.line), a.x, a.y, b.x, b.y);
  });
  return found;
}

std::vector<StraightRun> axes_of(const PlacedView& view, const model::Model& model,
                                 std::span<const Line> lines) {
  std::vector<StraightRun> runs;
  const auto axes = drawing::paper_axes(view.drawing.view);
  if (!axes || axes->eye) return runs;
  const drawing::OrthographicPaper paper(*axes, view.drawing.sheet.scale, lines.front());
  drawing::Axes2d found;
  drawing::find_axes(model, lines, paper, 0, found);
  for (const drawing::AxisPart& part : found.parts)
    runs.push_back({{part.a, part.b}, part.half_mm});
  return runs;
}

}  // namespace

std::vector<StraightRun> straight_runs(const PlacedView& view, const model::Model& model,
                                       model::ObjectId object) {
  std::vector<Line> visible;
  const auto own = std::ranges::equal_range(view.ink.lines, object, {}, &Line::object);
  std::ranges::copy_if(own, std::back_inserter(visible), [](const Line& line) {
    return line.state == drawing::LineState::visible && !(line.a_paper == line.b_paper);
  });
  if (visible.empty()) return {};
  std::vector<StraightRun> runs = axes_of(view, model, visible);
  if (runs.empty())
    for (const Line& line : visible) runs.push_back({{line.a_paper, line.b_paper}, 0});
  return joined(runs);
}

}  // namespace strake::sheets
