// SPDX-License-Identifier: Apache-2.0
#include "strake/drawing/thinning.hpp"

// Decision 0103 says why only what has lines on both sides is thinned.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/units.hpp"
#include "drawing/collinear/collinear_overlaps.hpp"
#include "drawing/ink/line_grid.hpp"
#include "drawing/ink/on_paper.hpp"
#include "drawing/layout/duplicates.hpp"
#include "drawing/layout/view_plane.hpp"
#include "strake/parallel/collect.hpp"

namespace strake::drawing {

namespace {

/// A line tests so many others of a cell at most, which are any of them. In a patch as dense as
/// that, lines on both sides are among these but for a few lines at its rim.
constexpr std::size_t kMaxOfCell = 256;

/// Returns whether a line may be left out: hatches have a spacing of their own, and the outline of
/// a cut is what a section is for.
bool may_be_thinned(const Line& line) {
  return line.kind != hlr::EdgeKind::hatch && line.kind != hlr::EdgeKind::section;
}

/// Returns on which side of a line another one beside it lies at a parameter: positive, negative,
/// or on the line.
double side_at(const PlaneSegment& line, const PlaneSegment& other, double t) {
  const double dx = line.bx - line.ax, dy = line.by - line.ay;
  const double x = line.ax + dx * t, y = line.ay + dy * t;
  const double ox = other.bx - other.ax, oy = other.by - other.ay;
  const double along = ox * dx + oy * dy;
  const double share = ((x - other.ax) * dx + (y - other.ay) * dy) / along;
  return (other.ay + oy * share - y) * dx - (other.ax + ox * share - x) * dy;
}

/// Intervals of a line beside which others lie, by side.
struct CoverBySide {
  std::vector<ParamInterval> left, right;
  bool whole_left = false, whole_right = false;

  void clear() {
    left.clear();
    right.clear();
    whole_left = whole_right = false;
  }
  void add(double side, const ParamInterval& interval) {
    const bool whole = interval.from <= 0 && interval.to >= 1;
    if (side > 0) {
      left.push_back(interval);
      whole_left = whole_left || whole;
    } else if (side < 0) {
      right.push_back(interval);
      whole_right = whole_right || whole;
    }
  }
  [[nodiscard]] bool whole() const { return whole_left && whole_right; }
};

/// Returns what two lists of intervals have in common.
std::vector<ParamInterval> common(std::span<const ParamInterval> a,
                                  std::span<const ParamInterval> b) {
  std::vector<ParamInterval> both;
  for (std::size_t i = 0, k = 0; i < a.size() && k < b.size();) {
    const double from = std::max(a[i].from, b[k].from), to = std::min(a[i].to, b[k].to);
    if (from < to) both.push_back({from, to});
    if (a[i].to < b[k].to)
      ++i;
    else
      ++k;
  }
  return both;
}

/// A visible line of an object.
struct InkedLine {
  PlaneSegment flat;
  std::uint32_t number = 0;
  bool stays = false;
  std::vector<ParamInterval> inner;  ///< where others lie on both sides of it
};

/// The lines of one object.
class ObjectThinner {
 public:
  ObjectThinner(std::vector<InkedLine>& lines, const LayingRule& rule)
      : lines_(lines), rule_(rule), cells_(flats_of(lines), 2 * spacing_of(lines)) {}

  /// Appends the intervals that stay, by number; lines that stay wholly have none.
  void run(const std::stop_token& stop, LineIntervals& out) {
    if (!find_inner(stop)) return;
    LaidLines laid(cells_, rule_.overlap);
    for (const InkedLine& line : lines_) lay_rims(line, laid);
    const std::size_t begin = out.size();
    std::uint32_t query = 0;
    for (const std::size_t i : across()) {
      if (query % 1024 == 0 && stop.stop_requested()) return;
      thin(lines_[i], query++, laid, out);
    }
    std::sort(out.begin() + static_cast<std::ptrdiff_t>(begin), out.end(),
              [](const LineInterval& a, const LineInterval& b) {
                return std::tie(a.line, a.from) < std::tie(b.line, b.from);
              });
  }

 private:
  static std::vector<PlaneSegment> flats_of(std::span<const InkedLine> lines) {
    std::vector<PlaneSegment> flats;
    flats.reserve(lines.size());
    for (const InkedLine& line : lines) flats.push_back(line.flat);
    return flats;
  }
  static double spacing_of(std::span<const InkedLine> lines) {
    return 2 * lines.front().flat.reach;
  }

  /// Finds the inner intervals of all lines; false where there are none, or `stop` is requested.
  bool find_inner(const std::stop_token& stop) {
    LaidLines all(cells_, rule_.overlap);
    const std::vector<std::uint32_t> mixed = mixed_up(static_cast<std::uint32_t>(lines_.size()));
    for (const std::uint32_t i : mixed) all.add(lines_[i].flat);
    bool any = false;
    CoverBySide sides;
    for (std::uint32_t i = 0; i < lines_.size(); ++i) {
      if (i % 1024 == 0 && stop.stop_requested()) return false;
      if (lines_[i].stays) continue;
      sides.clear();
      all.near(lines_[i].flat, i, kMaxOfCell, [&](std::uint32_t number) {
        const std::uint32_t k = mixed[number];
        if (k == i) return true;
        const PlaneSegment &line = lines_[i].flat, &other = lines_[k].flat;
        if (const auto beside = covered(line, other, rule_.overlap))
          sides.add(side_at(line, other, (beside->from + beside->to) / 2), *beside);
        return !sides.whole();
      });
      if (sides.left.empty() || sides.right.empty()) continue;
      unite(sides.left);
      unite(sides.right);
      lines_[i].inner = without_crumbs(lines_[i].flat, common(sides.left, sides.right));
      any = any || !lines_[i].inner.empty();
    }
    return any;
  }

  /// Returns the numbers up to a count in an order that has nothing to do with places: always the
  /// same.
  static std::vector<std::uint32_t> mixed_up(std::uint32_t count) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> keys;
    keys.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i)
      keys.emplace_back(static_cast<std::uint32_t>((i + 1) * 0x9E3779B97F4A7C15ULL >> 32U), i);
    if (count > kMaxOfCell) std::ranges::sort(keys);
    std::vector<std::uint32_t> order;
    order.reserve(count);
    for (const auto& [key, i] : keys) order.push_back(i);
    return order;
  }

  /// Returns inner intervals joined over short gaps: a line that is cut into crumbs would be dots.
  [[nodiscard]] std::vector<ParamInterval> without_crumbs(const PlaneSegment& flat,
                                                          std::vector<ParamInterval> inner) const {
    if (inner.empty()) return inner;
    LineIntervals cut;
    append_intervals(cut, 0, inner, rule_.overlap.shortest / flat.length());
    std::vector<ParamInterval> joined;
    for (const LineInterval& s : cut)
      if (s.covered) joined.push_back({s.from, s.to});
    return joined;
  }

  /// Lays down what of a line is at the rim of what is dense.
  static void lay_rims(const InkedLine& line, LaidLines& laid) {
    double done = 0;
    for (const ParamInterval& inner : line.inner) {
      if (inner.from > done) laid.add(part_of(line.flat, done, inner.from));
      done = inner.to;
    }
    if (done < 1) laid.add(part_of(line.flat, done, 1));
  }

  /// Returns the lines with inner intervals in the order in which one meets them across: those that
  /// are rather level downwards, the others to the right.
  [[nodiscard]] std::vector<std::size_t> across() const {
    using Place = std::tuple<bool, double, std::uint32_t, std::size_t>;
    std::vector<Place> places;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (lines_[i].inner.empty()) continue;
      const PlaneSegment& f = lines_[i].flat;
      const bool level = std::fabs(f.bx - f.ax) >= std::fabs(f.by - f.ay);
      places.emplace_back(level, level ? f.ay + f.by : f.ax + f.bx, lines_[i].number, i);
    }
    std::ranges::sort(places);
    std::vector<std::size_t> order;
    order.reserve(places.size());
    for (const Place& place : places) order.push_back(std::get<3>(place));
    return order;
  }

  /// Lays down what of the inner intervals of a line is not beside what is laid down.
  void thin(const InkedLine& line, std::uint32_t query, LaidLines& laid, LineIntervals& out) {
    covers_.clear();
    // Inner lines that stay were laid down last, and are what it may lie beside; where rims of a
    // scanned surface lie by thousands in a cell, it cannot ask all of them.
    laid.find(line.flat, query, covers_, kMaxOfCell);
    unite(covers_);
    std::vector<ParamInterval> gone = common(covers_, line.inner);
    const std::size_t first = out.size();
    append_kept(line.flat, line.number, gone, rule_, out);
    for (std::size_t k = first; k < out.size(); ++k)
      for (const ParamInterval& inner : line.inner) {
        const double from = std::max(out[k].from, inner.from), to = std::min(out[k].to, inner.to);
        if (from < to) laid.add(part_of(line.flat, from, to));
      }
    // A line of which nothing stays is reported by an interval without length.
    if (out.size() == first) out.push_back({line.number, true, 0, 0});
  }

  std::vector<InkedLine>& lines_;
  const LayingRule& rule_;
  LineGrid cells_;
  std::vector<ParamInterval> covers_;
};

/// How near the lines of an object may be.
struct ThinRule {
  LayingRule laying;
  double reach = 0;

  ThinRule(double spacing_mm, double touch)
      : laying{.overlap = {.least = 1e-3 + touch, .greatest_sine = 0.2, .shortest = spacing_mm},
               .whole_below = 2 * spacing_mm,
               .touch = touch},
        // Lines a spacing apart are not too near, whatever the grid made of their corners.
        reach(std::max(spacing_mm - touch, spacing_mm / 2) / 2) {}
};

/// Returns the intervals that stay of the lines that are thinned; `rule_of` says the rule of an
/// object.
template <class RuleOf>
Result<LineIntervals> thinned_intervals(const std::vector<Line>& lines, const OnPaper& on_paper,
                                        const RuleOf& rule_of, const parallel::Context& context) {
  return parallel::collect_with<LineInterval>(
      context, {.name = "dense lines", .n = lines.size(), .grain = 1024},
      [] { return std::vector<InkedLine>{}; },
      [&](std::vector<InkedLine>& own, std::size_t first, LineIntervals& out) {
        if (first > 0 && lines[first - 1].object == lines[first].object) return;
        own.clear();
        const ThinRule rule = rule_of(lines[first].object);
        for (std::size_t i = first; i < lines.size() && lines[i].object == lines[first].object;
             ++i) {
          if (lines[i].state != LineState::visible || lines[i].kind == hlr::EdgeKind::hatch)
            continue;
          PlaneSegment flat = on_paper(lines[i]);
          flat.reach = rule.reach;
          flat.rank = OverlapRank::visible;
          if (flat.length() > rule.laying.touch)
            own.push_back({flat, static_cast<std::uint32_t>(i), !may_be_thinned(lines[i]), {}});
        }
        // One that lies between two others is the least that can be thinned.
        if (own.size() > 2) ObjectThinner(own, rule.laying).run(context.stop, out);
      });
}

/// Puts the intervals that stay in the place of their lines, and counts what was left out.
std::vector<Line> with_intervals(std::span<const Line> lines, std::span<const LineInterval> kept,
                                 const PaperAxes& axes, ThinnedLines& thinned) {
  std::vector<Line> left;
  left.reserve(lines.size());
  const model::ObjectId* last = nullptr;
  std::size_t next = 0;
  for (std::uint32_t i = 0; i < lines.size(); ++i) {
    if (next == kept.size() || kept[next].line != i) {
      left.push_back(lines[i]);
      continue;
    }
    double share = 0;
    for (; next < kept.size() && kept[next].line == i; ++next) {
      if (kept[next].covered) continue;
      share += kept[next].to - kept[next].from;
      left.push_back(part_of(lines[i], axes, kept[next].from, kept[next].to));
    }
    if (share >= 1) continue;
    ++thinned.lines;
    if (last == nullptr || *last != lines[i].object) ++thinned.objects;
    last = &lines[i].object;
  }
  return left;
}

}  // namespace

Result<std::optional<ThinOptions>> parse_thinning(std::string_view text) {
  constexpr std::string_view kInModelSpace = "+dxf";
  std::string_view value = text;
  ThinOptions options;
  options.in_model_space = value.ends_with(kInModelSpace);
  if (options.in_model_space) value.remove_suffix(kInModelSpace.size());
  if (value == "off" && !options.in_model_space) return std::optional<ThinOptions>();
  if (value == "on") return std::optional(options);
  const Result<double> spacing = parse_distance_mm(value);
  if (!spacing || !(*spacing > 0 && *spacing <= 100))
    return Error{ErrorCode::usage,
                 "'" + std::string(text) + "' is no spacing of lines on paper",
                 {},
                 "write on, off, or how near lines may stand, as 0.5mm; with +dxf behind it model "
                 "space of DXF is thinned, too"};
  options.spacing_mm = *spacing;
  return std::optional(options);
}

Status thin_lines(Ink& ink, const NeutralDrawing& drawing, const ThinOptions& options,
                  const parallel::Context& context) {
  const double wide = std::max(ink.pens.outline, ink.pens.edge);
  ThinnedLines thinned{.spacing_mm = options.spacing_mm > 0 ? options.spacing_mm : 2 * wide};
  const auto axes = paper_axes(drawing.view);
  if (axes && !ink.lines.empty()) {
    const double touch = corner_rounding_mm(drawing.sheet.scale);
    // Two pens are those of the object's style.
    const auto rule_of = [&](model::ObjectId object) {
      const bool styled = options.spacing_mm <= 0 && ink.styles != nullptr;
      const double wider =
          styled ? ink.styles->widening(ink.styles->number_of(object), ink.pens.edge) : 1;
      return ThinRule(thinned.spacing_mm * wider, touch);
    };
    const Result<OnPaper> on_paper = OnPaper::of(ink.lines, *axes, drawing.sheet.scale, context);
    if (!on_paper) return on_paper.error();
    const auto kept = thinned_intervals(ink.lines, *on_paper, rule_of, context);
    if (!kept) return kept.error();
    std::vector<Line> left = with_intervals(ink.lines, *kept, *axes, thinned);
    if (thinned.lines > 0) {
      std::swap(ink.lines, left);
      if (!options.in_model_space) ink.true_size_lines = std::move(left);
    }
  }
  ink.thinned = thinned;
  return {};
}

}  // namespace strake::drawing
