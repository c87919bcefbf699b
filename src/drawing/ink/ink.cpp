// SPDX-License-Identifier: Apache-2.0
#include "strake/drawing/ink.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "drawing/collinear/collinear_overlaps.hpp"
#include "drawing/ink/hidden_ink.hpp"
#include "drawing/ink/on_paper.hpp"
#include "drawing/layout/duplicates.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::drawing {

namespace {

/// The length of lines per area of paper, by square.
class Density {
 public:
  /// Millimetres of lines in each square.
  using Lengths = std::vector<double>;

  explicit Density(const Sheet& sheet)
      : width_mm_(sheet.width_mm),
        height_mm_(sheet.height_mm),
        size_(std::max(4.0, std::sqrt(sheet.width_mm * sheet.height_mm) / 500)),
        columns_(count(sheet.width_mm)),
        rows_(count(sheet.height_mm)) {}

  [[nodiscard]] Lengths none() const { return Lengths(columns_ * rows_); }

  /// What of a line lies off the sheet does not count: it may be as long as the scale makes it.
  void add(const Line& line, Lengths& lengths) const {
    const double dx = line.b_paper.x - line.a_paper.x, dy = line.b_paper.y - line.a_paper.y;
    const double length = std::sqrt(dx * dx + dy * dy);
    const double steps = std::ceil(length * 2 / size_);
    double from = 0, to = 1;
    keep_between(line.a_paper.x, dx, width_mm_, from, to);
    keep_between(line.a_paper.y, dy, height_mm_, from, to);
    const double last = std::min(std::floor(to * steps), steps - 1);
    for (double i = std::max(std::ceil(from * steps) - 1, 0.0); i <= last; ++i) {
      const double t = (i + 0.5) / steps;
      lengths[index(line.a_paper.y + dy * t, rows_) * columns_ +
              index(line.a_paper.x + dx * t, columns_)] += length / steps;
    }
  }

  /// Returns the density as a reader's eye meets it: per mm of paper, averaged over the lines.
  [[nodiscard]] double along_lines(const Lengths& lengths) const {
    double sum = 0, squares = 0;
    for (const double length : lengths) {
      sum += length;
      squares += length * length;
    }
    return sum > 0 ? squares / sum / (size_ * size_) : 0;
  }

 private:
  /// Narrows the part of a line, which runs `step` from `at`, to what lies on the sheet; `from` is
  /// greater than `to` where nothing does.
  static void keep_between(double at, double step, double limit, double& from, double& to) {
    if (step == 0) {
      if (at < 0 || at > limit) to = -1;
      return;
    }
    const double near = -at / step, far = (limit - at) / step;
    from = std::max(from, std::min(near, far));
    to = std::min(to, std::max(near, far));
  }

  [[nodiscard]] std::size_t count(double mm) const {
    return static_cast<std::size_t>(std::max(1.0, std::ceil(mm / size_)));
  }
  [[nodiscard]] std::size_t index(double mm, std::size_t n) const {
    const double cell = std::floor(mm / size_);
    return cell <= 0 ? 0 : std::min(static_cast<std::size_t>(cell), n - 1);
  }

  double width_mm_, height_mm_;
  double size_;
  std::size_t columns_, rows_;
};

// Line groups of ISO 128-2, wide to narrow as 2 to 1, the widths rounded as the standard rounds
// them; outlines of cuts are a width above. The last is finer than the standard's, for models of
// many thousand lines. Decision 0068 says why outlines and edges are of one width.
constexpr std::array<Pens, 5> kLineGroups{{
    {.outline = 0.7, .edge = 0.7, .thin = 0.35, .section = 1},
    {.outline = 0.5, .edge = 0.5, .thin = 0.25, .section = 0.7},
    {.outline = 0.35, .edge = 0.35, .thin = 0.18, .section = 0.5},
    {.outline = 0.25, .edge = 0.25, .thin = 0.13, .section = 0.35},
    {.outline = 0.18, .edge = 0.18, .thin = 0.09, .section = 0.25},
}};

/// The largest fraction of the paper that visible lines may blacken where they are.
constexpr double kMaxBlackened = 0.35;

/// Returns whether a sheet is larger than an A2, and may have the widest group.
bool is_large(const Sheet& sheet) {
  constexpr double kA2LongerSideMm = 594;
  return std::max(sheet.width_mm, sheet.height_mm) > kA2LongerSideMm;
}

/// Returns whether a line may be dashed. Dashed hatching would suggest a cut hidden face, and a
/// smooth edge is worth a hint only.
bool may_be_dashed(const Line& line) {
  return is_hidden(line.state) && line.kind != hlr::EdgeKind::hatch &&
         line.kind != hlr::EdgeKind::smooth;
}

/// Lines that a worker takes at once where little is done for each.
constexpr std::size_t kLinesPerRun = 16384;

Result<std::vector<PlaneSegment>> flatten(const Ink& ink, const OnPaper& on_paper, double touch,
                                          const parallel::Context& context) {
  const std::vector<Line>& lines = ink.lines;
  return parallel::transform(
      context, {.name = "lines as segments", .n = lines.size(), .grain = kLinesPerRun},
      [&](std::size_t i) {
        const Line& line = lines[i];
        PlaneSegment f = on_paper(line);
        f.reach = (width_of(line, ink) + touch) / 2;
        if (is_hidden(line.state))
          f.rank = OverlapRank::hidden;
        else if (f.length() > 0)
          f.rank = OverlapRank::visible;
        return f;
      });
}

/// Chooses the intervals of hidden lines that are left beside visible lines and beside hidden ones
/// of their own object, without edges seen end-on. Hidden lines of other objects do not matter: in
/// a row of objects the first would take a line of the second, and so on, and equal ones would look
/// unequal.
class HiddenChooser {
 public:
  HiddenChooser(const std::vector<Line>& lines, const OnPaper& on_paper,
                const std::vector<PlaneSegment>& flat, const LineOverlaps& beside_visible)
      : lines_(lines), on_paper_(on_paper), flat_(flat), beside_visible_(beside_visible) {}

  /// Returns intervals by line, then from a to b; a line without ink has none. Errors: cancelled.
  [[nodiscard]] Result<LineIntervals> run(const LayingRule& rule,
                                          const parallel::Context& context) const {
    return parallel::collect_with<LineInterval>(
        context, {.name = "ink of hidden lines", .n = lines_.size(), .grain = 1024},
        [] { return std::vector<HiddenLine>{}; },
        [&](std::vector<HiddenLine>& own, std::size_t first, LineIntervals& out) {
          if (first > 0 && lines_[first - 1].object == lines_[first].object) return;
          own.clear();
          for (std::size_t i = first; i < lines_.size() && lines_[i].object == lines_[first].object;
               ++i)
            if (flat_[i].rank == OverlapRank::hidden && flat_[i].length() > rule.touch &&
                !beside_visible_.fully_covered.is_set(i))
              own.push_back(hidden_line(static_cast<std::uint32_t>(i)));
          choose_hidden_lines(own, rule, context.stop, out);
        });
  }

 private:
  [[nodiscard]] HiddenLine hidden_line(std::uint32_t i) const {
    HiddenLine line{flat_[i], on_paper_.order(lines_[i], flat_[i]), i, {}};
    for (const LineInterval& s : std::ranges::equal_range(
             beside_visible_.cut_intervals, i, {}, [](const LineInterval& s) { return s.line; }))
      if (s.covered) line.covers.push_back({s.from, s.to});
    return line;
  }

  const std::vector<Line>& lines_;
  const OnPaper& on_paper_;
  const std::vector<PlaneSegment>& flat_;
  const LineOverlaps& beside_visible_;
};

/// Leaves of the hidden lines the intervals that are kept, which are by line.
Status keep_intervals(Ink& ink, std::span<const PlaneSegment> flat, const LineIntervals& kept,
                      const PaperAxes& axes, const parallel::Context& context) {
  const std::vector<Line>& lines = ink.lines;
  const std::size_t runs = (lines.size() + kLinesPerRun - 1) / kLinesPerRun;
  std::vector<std::uint64_t> left_out(runs);
  auto left = parallel::collect<Line>(
      context, {.name = "lines left on paper", .n = runs},
      [&](std::size_t r, std::vector<Line>& out) {
        const std::size_t first = r * kLinesPerRun;
        const std::size_t last = std::min(lines.size(), first + kLinesPerRun);
        auto next = std::ranges::lower_bound(kept, first, {}, &LineInterval::line);
        for (std::size_t i = first; i < last; ++i) {
          if (flat[i].rank != OverlapRank::hidden) {
            out.push_back(lines[i]);
            continue;
          }
          double length = 0;
          for (; next != kept.end() && next->line == i; ++next) {
            length += next->to - next->from;
            out.push_back(part_of(lines[i], axes, next->from, next->to));
          }
          if (length < 1) ++left_out[r];
        }
      });
  if (!left) return left.error();
  ink.lines = std::move(*left);
  for (const std::uint64_t lines_of_run : left_out) ink.left_out += lines_of_run;
  return {};
}

Status clean_up(Ink& ink, const NeutralDrawing& drawing, const PaperAxes& axes,
                const parallel::Context& context) {
  const double thin = ink.pens.thin, scale = drawing.sheet.scale;
  // Ink that would just touch counts as touching.
  const double touch = corner_rounding_mm(scale);
  // Lines that cross, or of which one begins on the other, do not run along each other.
  const OverlapRule along{.least = 1e-3 + touch,
                          .greatest_sine = 0.2,
                          .covers_visible = false,
                          .hidden_covers = false,
                          .shortest = kDashGap * thin + touch};
  const Result<OnPaper> on_paper = OnPaper::of(ink.lines, axes, scale, context);
  if (!on_paper) return on_paper.error();
  const auto flat = flatten(ink, *on_paper, touch, context);
  if (!flat) return flat.error();
  const auto overlaps = cut_overlaps(*flat, along, context);
  if (!overlaps) return overlaps.error();
  const auto kept =
      HiddenChooser(ink.lines, *on_paper, *flat, *overlaps)
          .run({.overlap = along, .whole_below = kDash * thin + touch, .touch = touch}, context);
  if (!kept) return kept.error();
  return keep_intervals(ink, *flat, *kept, axes, context);
}

}  // namespace

Result<Pens> choose_pens(const NeutralDrawing& drawing, const parallel::Context& context) {
  // Each block of lines has squares of its own, so that there are few, and long ones.
  constexpr std::size_t kMaxBlocks = 32;
  const std::size_t lines = drawing.lines.size();
  const Density density(drawing.sheet);
  const auto lengths = parallel::reduce(
      context,
      {.name = "density of lines",
       .n = lines,
       .grain = std::max(kLinesPerRun, (lines + kMaxBlocks - 1) / kMaxBlocks)},
      density.none(),
      [&](Density::Lengths& of_block, std::size_t i) {
        const Line& line = drawing.lines[i];
        if (line.state == LineState::visible && line.kind != hlr::EdgeKind::hatch)
          density.add(line, of_block);
      },
      [](Density::Lengths& into, const Density::Lengths& of_block) {
        std::ranges::transform(into, of_block, into.begin(), std::plus{});
      });
  if (!lengths) return lengths.error();
  const double per_mm = density.along_lines(*lengths);
  const auto groups = std::span(kLineGroups).subspan(is_large(drawing.sheet) ? 0 : 1);
  for (const Pens& pens : groups)
    if (per_mm * pens.edge <= kMaxBlackened) return pens;
  return groups.back();
}

Result<Ink> choose_ink(const NeutralDrawing& drawing, const InkOptions& options,
                       const parallel::Context& context) {
  Ink ink;
  if (options.pens) {
    ink.pens = *options.pens;
  } else {
    const Result<Pens> pens = choose_pens(drawing, context);
    if (!pens) return pens.error();
    ink.pens = *pens;
  }
  ink.split_hidden = options.split_hidden;
  ink.styles = options.styles;
  auto lines = parallel::collect<Line>(
      context, {.name = "lines on paper", .n = drawing.lines.size(), .grain = kLinesPerRun},
      [&](std::size_t i, std::vector<Line>& out) {
        const Line& line = drawing.lines[i];
        if (line.state == LineState::visible || (options.hidden && may_be_dashed(line)))
          out.push_back(line);
      });
  if (!lines) return lines.error();
  ink.lines = std::move(*lines);
  const auto axes = paper_axes(drawing.view);
  if (options.hidden && options.clean_up && axes)
    if (const Status status = clean_up(ink, drawing, *axes, context); !status)
      return status.error();
  return ink;
}

}  // namespace strake::drawing
