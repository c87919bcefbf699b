// SPDX-License-Identifier: Apache-2.0
#include "strake/drawing/break_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "drawing/layout/view_plane.hpp"
#include "drawing/strokes/join_lines.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/collect.hpp"

namespace strake::drawing {

namespace {

/// How far a break line goes on beyond what it crosses, and how far apart its zigzags are at most.
constexpr double kBeyondMm = 2, kApartMm = 80;
/// Break lines of two sides that both end so near to the corner between them meet there.
constexpr double kMeetMm = 2 * kBeyondMm;
/// Beyond what any sheet is wide, zigzags lie farther apart: at a large scale there were millions.
constexpr double kMaxZigzags = 64;
/// A zigzag's length along the line and its height to each side.
constexpr double kZigzagMm = 3, kZigzagHeightMm = 2;
/// What is narrower on paper than this is a line, and a break line across it a dot.
constexpr double kNarrowestMm = 0.2;

/// The end of a line where a side of the limits cuts it. A line that lies on another has ends, too:
/// where objects are flush, one of them has the line of both.
struct CutEnd {
  std::uint8_t side = 0;  ///< axis, and 3 more for the upper side
  bool visible = false;   ///< otherwise a duplicate
  model::ObjectId object{};
  PaperPoint at;
};

/// The sides of a box in the model, mm.
class LimitSides {
 public:
  explicit LimitSides(const geometry::Box3l& limits)
      : lo_(geometry::to_mm(limits.lo)), hi_(geometry::to_mm(limits.hi)) {}

  /// Returns the side on which an end lies from which the line goes on to a point outside.
  [[nodiscard]] std::optional<std::uint8_t> of(const geometry::Vec3d& end,
                                               const geometry::Vec3d& beyond) const {
    // Both are rounded to the grid.
    constexpr double kOn = 2.5 * geometry::kMmPerGrid;
    for (int k = 0; k < 3; ++k) {
      if (std::fabs(end[k] - lo_[k]) <= kOn && beyond[k] < lo_[k])
        return static_cast<std::uint8_t>(k);
      if (std::fabs(end[k] - hi_[k]) <= kOn && beyond[k] > hi_[k])
        return static_cast<std::uint8_t>(k + 3);
    }
    return std::nullopt;
  }

 private:
  geometry::Vec3d lo_, hi_;
};

/// Returns the cut ends of a line beside one that is clipped, its neighbour on the same edge.
void add_cut_end(const Line& line, const Line& next, const LimitSides& sides,
                 std::vector<CutEnd>& out) {
  const bool visible = line.state == LineState::visible;
  if ((!visible && line.state != LineState::duplicate) || next.state != LineState::clipped ||
      line.object != next.object || line.edge != next.edge)
    return;
  const auto add = [&](const geometry::Vec3d& end, const PaperPoint& at,
                       const geometry::Vec3d& beyond) {
    if (const auto side = sides.of(end, beyond)) out.push_back({*side, visible, line.object, at});
  };
  if (line.b_mm == next.a_mm) return add(line.b_mm, line.b_paper, next.b_mm);
  if (line.a_mm == next.b_mm) return add(line.a_mm, line.a_paper, next.a_mm);
}

PaperPoint beside(const PaperPoint& from, const PaperPoint& unit, double along, double across) {
  return {rounded_paper(from.x + unit.x * along - unit.y * across),
          rounded_paper(from.y + unit.y * along + unit.x * across)};
}

/// Where a break line begins or ends: at a corner of the limits it does not go on.
struct BreakEnd {
  PaperPoint at;
  bool corner = false;
};

/// Returns the break line across what lies between two points, which are apart.
BreakLine break_line(model::ObjectId object, const BreakEnd& a, const BreakEnd& b) {
  const double width = distance(a.at, b.at);
  const PaperPoint unit{(b.at.x - a.at.x) / width, (b.at.y - a.at.y) / width};
  const double beyond = std::min(kBeyondMm, width / 2);
  const double size = std::min(1.0, width / (2 * kZigzagMm));
  const double count = std::min(std::ceil(width / kApartMm), kMaxZigzags);
  BreakLine line{object, {beside(a.at, unit, a.corner ? 0 : -beyond, 0)}};
  for (double k = 0; k < count; ++k) {
    const double middle = width * (k + 0.5) / count, half = size * kZigzagMm / 2;
    line.points.push_back(beside(a.at, unit, middle - half, 0));
    line.points.push_back(beside(a.at, unit, middle - half / 2, size * kZigzagHeightMm));
    line.points.push_back(beside(a.at, unit, middle + half / 2, -size * kZigzagHeightMm));
    line.points.push_back(beside(a.at, unit, middle + half, 0));
  }
  line.points.push_back(beside(a.at, unit, b.corner ? width : width + beyond, 0));
  return line;
}

/// Returns the point of some that is farthest from another; of equally far ones the first.
PaperPoint farthest(std::span<const CutEnd> ends, const PaperPoint& from) {
  return std::ranges::max_element(ends, {},
                                  [&](const CutEnd& end) { return distance(end.at, from); })
      ->at;
}

/// What is cut of an object, on the line that a side is on paper.
struct CutSpan {
  double from = 0, to = 0;
  model::ObjectId object{};
  BreakEnd a, b;
};

/// Makes one span of those that meet.
std::vector<CutSpan> joined(std::vector<CutSpan> spans) {
  std::ranges::sort(spans, {}, [](const CutSpan& s) { return std::tuple(s.from, s.to, s.object); });
  std::vector<CutSpan> found;
  for (std::size_t i = 0; i < spans.size();) {
    CutSpan one = spans[i];
    for (++i; i < spans.size() && spans[i].from <= one.to + kBeyondMm; ++i) {
      one.object = std::min(one.object, spans[i].object);
      if (spans[i].to <= one.to) continue;
      one.to = spans[i].to;
      one.b = spans[i].b;
    }
    found.push_back(one);
  }
  return found;
}

/// What a side of the limits cuts.
struct CutSide {
  std::optional<PaperPoint> along;  ///< its direction on paper, where it is seen edge-on
  std::vector<CutSpan> spans;       ///< where it is, from one end to the other
  std::vector<BreakLine> askew;     ///< where it is not
};

class BreakFinder {
 public:
  explicit BreakFinder(const PaperAxes& axes) : axes_(axes) {}

  /// Adds what one side cuts, whose ends come object by object.
  void add(std::span<const CutEnd> ends) {
    const std::uint8_t number = ends.front().side;
    // Of a side that is seen square the lines that it cuts have no end to be seen.
    if (is_square(number % 3)) return;
    CutSide& side = sides_.at(number);
    side.along = along_of(number % 3);
    for (std::size_t i = 0; i < ends.size();) {
      std::size_t end = i + 1;
      while (end < ends.size() && ends[end].object == ends[i].object) ++end;
      const auto own = ends.subspan(i, end - i);
      i = end;
      // All of an object that is hidden may lie on lines of others.
      if (std::ranges::none_of(own, &CutEnd::visible)) continue;
      if (side.along)
        add_span(own, *side.along, side.spans);
      else
        add_askew(own, side.askew);
    }
    side.spans = joined(std::move(side.spans));
  }

  /// Returns the break lines of all sides that were added.
  std::vector<BreakLine> take() && {
    for (std::size_t one = 0; one < sides_.size(); ++one)
      for (std::size_t other = one + 1; other < sides_.size(); ++other)
        if (other != one + 3) meet(sides_.at(one), sides_.at(other));
    std::vector<BreakLine> found;
    for (CutSide& side : sides_) {
      std::ranges::move(side.askew, std::back_inserter(found));
      for (const CutSpan& span : side.spans)
        found.push_back(break_line(span.object, span.a, span.b));
    }
    return found;
  }

 private:
  [[nodiscard]] bool is_square(int axis) const {
    return axes_.toward[(axis + 1) % 3] == 0 && axes_.toward[(axis + 2) % 3] == 0;
  }

  /// Returns the direction on paper of a side that is seen edge-on.
  [[nodiscard]] std::optional<PaperPoint> along_of(int axis) const {
    if (axes_.eye || axes_.toward[axis] != 0) return std::nullopt;
    // The line of the side is square to its normal.
    const double x = axes_.up[axis], y = axes_.right[axis];
    const bool turned = x < 0 || (x == 0 && y < 0);
    return turned ? PaperPoint{-x, -y} : PaperPoint{x, y};
  }

  static void add_span(std::span<const CutEnd> ends, const PaperPoint& along,
                       std::vector<CutSpan>& spans) {
    const auto place = [&](const CutEnd& end) { return end.at.x * along.x + end.at.y * along.y; };
    const auto [first, last] = std::ranges::minmax_element(ends, {}, place);
    if (place(*last) - place(*first) >= kNarrowestMm)
      spans.push_back({place(*first), place(*last), ends.front().object, {first->at}, {last->at}});
  }

  static void add_askew(std::span<const CutEnd> ends, std::vector<BreakLine>& out) {
    const PaperPoint a = farthest(ends, ends.front().at), b = farthest(ends, a);
    if (distance(a, b) >= kNarrowestMm) out.push_back(break_line(ends.front().object, {a}, {b}));
  }

  /// Has the break lines of two sides meet at the corner between them, where both end near to it.
  static void meet(CutSide& one, CutSide& other) {
    if (one.spans.empty() || other.spans.empty()) return;
    const PaperPoint &p = one.spans.front().a.at, &q = other.spans.front().a.at;
    const PaperPoint &u = *one.along, &v = *other.along;
    const double turn = u.x * v.y - u.y * v.x;
    // Of a view along no axis two sides may be parallel on paper.
    if (std::fabs(turn) < 1e-6) return;
    const double t = ((q.x - p.x) * v.y - (q.y - p.y) * v.x) / turn;
    const PaperPoint corner{rounded_paper(p.x + u.x * t), rounded_paper(p.y + u.y * t)};
    BreakEnd* const first = end_near(one.spans, corner);
    BreakEnd* const second = end_near(other.spans, corner);
    if (first == nullptr || second == nullptr) return;
    *first = *second = {corner, true};
  }

  /// Returns the end of a break line that is so near to a corner that it may meet another there.
  static BreakEnd* end_near(std::vector<CutSpan>& spans, const PaperPoint& corner) {
    BreakEnd* nearest = nullptr;
    double least = kMeetMm;
    for (CutSpan* const span : {&spans.front(), &spans.back()})
      for (BreakEnd* const end : {&span->a, &span->b})
        if (const double apart = distance(end->at, corner); apart <= least) {
          nearest = end;
          least = apart;
        }
    return nearest;
  }

  const PaperAxes& axes_;
  std::array<CutSide, 6> sides_;  ///< by axis, and 3 more for the upper side
};

}  // namespace

Result<std::vector<BreakLine>> find_break_lines(const NeutralDrawing& drawing,
                                                const parallel::Context& context) {
  const auto axes = paper_axes(drawing.view);
  if (!drawing.view.limits || !axes) return std::vector<BreakLine>();
  const LimitSides sides(*drawing.view.limits);
  const std::vector<Line>& lines = drawing.lines;
  auto ends =
      parallel::collect<CutEnd>(context, {.name = "break lines", .n = lines.size(), .grain = 8192},
                                [&](std::size_t i, std::vector<CutEnd>& out) {
                                  if (i > 0) add_cut_end(lines[i], lines[i - 1], sides, out);
                                  if (i + 1 < lines.size())
                                    add_cut_end(lines[i], lines[i + 1], sides, out);
                                });
  if (!ends) return ends.error();
  BreakFinder finder(*axes);
  // Ends of a side stay in the order of the drawing, which is by object.
  for (std::uint8_t side = 0; side < 6; ++side) {
    std::vector<CutEnd> of_side;
    std::ranges::copy_if(*ends, std::back_inserter(of_side),
                         [&](const CutEnd& end) { return end.side == side; });
    if (!of_side.empty()) finder.add(of_side);
  }
  return std::move(finder).take();
}

}  // namespace strake::drawing
