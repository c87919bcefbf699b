// SPDX-License-Identifier: Apache-2.0
#include "sheets/labels/along_tags.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "drawing/centre/axes.hpp"
#include "drawing/layout/view_plane.hpp"
#include "sheets/arrangement/view_paper.hpp"
#include "sheets/labels/paper/sheet_lines.hpp"
#include "sheets/spec/paper_segments.hpp"
#include "sheets/spec/text_metrics.hpp"

namespace strake::sheets {
namespace {

using drawing::Line;

/// A straight part of an object on paper.
struct StraightRun {
  PaperSegment line;   ///< the axis of what is round, or else a line of the object
  double half_mm = 0;  ///< how far what is round reaches to both sides of its axis
};

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
    return std::tuple(-length_of(run.line), a.x, a.y, b.x, b.y, run.half_mm);
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

/// Returns the straight runs of an object, the longest first: the axes of its exact round bodies as
/// far as visible lines run beside them, what lies in line as one; of an object without such axes,
/// of a pipe that is drawn as a single line or as a mesh, its straight visible lines.
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

/// A run goes on beyond its text by so much at both ends, and places for the text are so far apart.
constexpr double kBeyondMm = 1, kStepMm = 1;
/// So many of the longest runs of an object are looked at.
constexpr std::size_t kMaxRuns = 8;

/// Letters that hang reach so far below the line on which a text stands, in heights of a capital.
constexpr double kHanging = 0.25;

/// Returns how far above a run texts may stand, the best first (decision 0110).
std::vector<double> heights_above(const StraightRun& run, double height_mm) {
  const double apart = kClearanceMm + kHanging * height_mm + 0.05;
  std::vector<double> above;
  if (run.half_mm > height_mm / 2 + kClearanceMm) above.push_back(-height_mm / 2);
  for (const double from : {0.0, run.half_mm}) {
    // The outline of a pipe may lie a little beside what its radius says.
    for (const double more : {0.0, 0.2, 0.5}) above.push_back(from + apart + more);
    if (run.half_mm == 0) break;
  }
  return above;
}

}  // namespace

AlongTags::AlongTags(const Sheet& sheet, const model::Model& model, const SheetArea& room,
                     OccupancyGrid& occupied)
    : model_(model), room_(room), occupied_(occupied), lines_(sheet.width_mm, sheet.height_mm) {
  each_line(sheet, [&](const PaperPoint& a, const PaperPoint& b) { lines_.add({a, b}); });
}

std::optional<Text> AlongTags::place(const PlacedView& view, model::ObjectId object,
                                     const std::string& text, double height_mm) {
  const double width = text_width(text) * height_mm;
  std::vector<StraightRun> runs = straight_runs(view, model_, object);
  // At a large scale a run is kilometres long on a sheet of a metre.
  std::erase_if(runs, [&](StraightRun& run) {
    const auto on_sheet = clipped(run.line, room_.area);
    if (on_sheet) run.line = *on_sheet;
    return !on_sheet;
  });
  std::ranges::sort(runs, {}, [](const StraightRun& run) {
    const auto& [a, b] = run.line;
    return std::tuple(-length_of(run.line), a.x, a.y, b.x, b.y, run.half_mm);
  });
  for (std::size_t r = 0; r < std::min(runs.size(), kMaxRuns); ++r) {
    const auto& [a, b] = runs[r].line;
    const double length = length_of(runs[r].line), spare = length - width - 2 * kBeyondMm;
    if (spare < 0) break;
    const PaperPoint way = reading_way({(b.x - a.x) / length, (b.y - a.y) / length});
    const PaperPoint up{way.y, -way.x}, middle{(a.x + b.x) / 2, (a.y + b.y) / 2};
    for (const double above : heights_above(runs[r], height_mm))
      for (double aside = 0; aside <= spare / 2; aside += kStepMm)
        for (const double sign : {-1.0, 1.0}) {
          Text tag{LineClass::leader,
                   rounded(along(along(middle, way, sign * aside), up, above)),
                   height_mm,
                   Align::middle,
                   text,
                   true,
                   reading_turn(way)};
          if (!is_free(tag, width, way)) continue;
          take(tag);
          return tag;
        }
  }
  return std::nullopt;
}

/// Returns whether a text covers nothing: no line within the clearance, and nothing that blocks.
bool AlongTags::is_free(const Text& text, double width_mm, const PaperPoint& way) const {
  const std::vector<PaperBox> boxes = boxes_of(text);
  if (!std::ranges::all_of(boxes, [&](const PaperBox& box) { return room_.takes(box); }))
    return false;
  const double low = kHanging * text.height_mm, height = text.height_mm + low;
  const PaperPoint up{way.y, -way.x};
  const PaperPoint middle = along(text.at, up, (text.height_mm - low) / 2);
  if (lines_.any_in({middle, way, width_mm / 2 + kClearanceMm, height / 2 + kClearanceMm}))
    return false;
  const double rows = std::ceil(height / 0.5);
  for (double row = 0; row <= rows; ++row) {
    const PaperPoint on = along(text.at, up, height * row / rows - low);
    if (!occupied_.leader_path(along(on, way, -width_mm / 2), along(on, way, width_mm / 2)).open)
      return false;
  }
  return true;
}

void AlongTags::take(const Text& text) {
  for (const PaperBox& box : boxes_of(text)) occupied_.block(box);
  const std::array<PaperPoint, 4> corners = corners_of(text);
  for (std::size_t c = 0; c < corners.size(); ++c)
    lines_.add({corners[c], corners[(c + 1) % corners.size()]});
}

}  // namespace strake::sheets
