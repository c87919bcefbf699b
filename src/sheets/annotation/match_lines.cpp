// SPDX-License-Identifier: Apache-2.0
#include "sheets/annotation/match_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "sheets/arrangement/view_margins.hpp"
#include "sheets/spec/text_metrics.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::sheets {

namespace {

/// A text stands off its match line by so much.
constexpr double kOffLineMm = 1.5;
/// Smaller letters are not read.
constexpr double kMinMatchLettersMm = 1.8;

/// A side of limits on paper: a line, and which way leads out of the view.
struct SideOnPaper {
  PaperPoint on, way, out;
};

/// Returns where along its line a side begins and ends.
std::pair<double, double> reach_of(const geometry::Box3l& side, const ViewPaper& paper,
                                   const SideOnPaper& line) {
  std::pair<double, double> reach{1e300, -1e300};
  for (int corner = 0; corner < 8; ++corner) {
    const geometry::Vec3l at_corner{corner % 2 == 0 ? side.lo.x : side.hi.x,
                                    corner / 2 % 2 == 0 ? side.lo.y : side.hi.y,
                                    corner < 4 ? side.lo.z : side.hi.z};
    const PaperPoint p = paper.point(geometry::to_mm(at_corner));
    const double at = (p.x - line.on.x) * line.way.x + (p.y - line.on.y) * line.way.y;
    reach = {std::min(reach.first, at), std::max(reach.second, at)};
  }
  return reach;
}

SideOnPaper side_on_paper(const NeighbourView& neighbour, const ViewPaper& paper) {
  geometry::Vec3d normal;
  normal[neighbour.axis] = neighbour.upper ? 1 : -1;
  const PaperPoint out = paper.vector(normal);
  return {paper.point(geometry::to_mm(neighbour.side.lo)), {-out.y, out.x}, out};
}

/// Returns the line on paper of what a view shares with its neighbour; none: nothing of the view
/// comes near to it.
std::optional<PaperSegment> line_of(const NeighbourView& neighbour, const MarkedView& in,
                                    const ViewPaper& paper, const SideOnPaper& side) {
  geometry::Box3l whole = *in.spec.view.limits;
  whole.lo[neighbour.axis] = whole.hi[neighbour.axis] = neighbour.side.lo[neighbour.axis];
  const auto own = reach_of(whole, paper, side);
  auto [from, to] = reach_of(neighbour.side, paper, side);
  // At the ends of what the view shows nothing is beside the line, and it goes on.
  if (from <= own.first) from -= kMatchBeyondMm;
  if (to >= own.second) to += kMatchBeyondMm;
  return clipped({along(side.on, side.way, from), along(side.on, side.way, to)},
                 widened(in.lines, kMatchBeyondMm));
}

/// Returns the text beside a match line, in the middle of it or so far from that that it covers
/// nothing.
Text text_beside(std::string words, const PaperSegment& line, const SideOnPaper& side,
                 double letters_mm, std::span<const PaperBox> taken) {
  const double length = length_of(line);
  const PaperPoint way = reading_way(side.way), up{way.y, -way.x};
  const PaperPoint middle{(line.a.x + line.b.x) / 2, (line.a.y + line.b.y) / 2};
  Text text{LineClass::match_line, {},   letters_mm,       Align::middle,
            std::move(words),      true, reading_turn(way)};
  text = shrunk_to_width(std::move(text), length, kMinMatchLettersMm);
  text.height_mm = drawing::rounded_paper(text.height_mm);
  // Letters that hang reach a quarter of their height below the line on which they stand.
  const bool above = up.x * side.out.x + up.y * side.out.y > 0;
  const double off = above ? kOffLineMm + text.height_mm / 4 : -kOffLineMm - text.height_mm;
  const double spare = std::max(0.0, (length - text_width(text.text) * text.height_mm) / 2);
  const auto stands_free = [&] {
    return std::ranges::none_of(boxes_of(text), [&](const PaperBox& box) {
      return std::ranges::any_of(taken, [&](const PaperBox& t) { return t.overlaps(box); });
    });
  };
  const auto move_to = [&](double aside) {
    text.at = rounded(along(along(middle, way, aside), up, off));
  };
  // It may reach a little beyond the end of its line before it covers anything.
  constexpr double kMatchStepMm = 2, kPastEndMm = 12;
  for (double aside = 0; aside <= spare + kPastEndMm; aside += kMatchStepMm)
    for (const double sign : {1.0, -1.0}) {
      move_to(sign * aside);
      if (stands_free()) return text;
    }
  // Where there is no free paper it stands where it belongs.
  move_to(0);
  return text;
}

/// Places along a line, of points that lie on it.
class AlongLine {
 public:
  explicit AlongLine(const PaperSegment& line)
      : line_(line),
        length_(length_of(line)),
        way_{(line.b.x - line.a.x) / length_, (line.b.y - line.a.y) / length_} {}

  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] double at(const PaperPoint& p) const {
    return (p.x - line_.a.x) * way_.x + (p.y - line_.a.y) * way_.y;
  }
  [[nodiscard]] bool holds(const PaperPoint& p) const {
    constexpr double kNear = 0.02;
    return std::fabs((p.y - line_.a.y) * way_.x - (p.x - line_.a.x) * way_.y) <= kNear;
  }

 private:
  const PaperSegment& line_;
  double length_;
  PaperPoint way_;
};

/// Returns what is left of a grid line beside a match line.
std::vector<Path> beside(const Path& grid_line, const PaperSegment& match_line,
                         const AlongLine& on) {
  PaperPoint a = grid_line.points.front(), b = grid_line.points.back();
  if (grid_line.line != LineClass::grid || !on.holds(a) || !on.holds(b)) return {grid_line};
  if (on.at(a) > on.at(b)) std::swap(a, b);
  if (on.at(b) <= 0 || on.at(a) >= on.length()) return {grid_line};
  std::vector<Path> left;
  if (on.at(a) < 0) left.push_back({LineClass::grid, {a, rounded(match_line.a)}, false});
  if (on.at(b) > on.length()) left.push_back({LineClass::grid, {rounded(match_line.b), b}, false});
  return left;
}

}  // namespace

std::optional<PaperSegment> draw_match_line(const NeighbourView& neighbour,
                                            std::size_t sheet_number, const MarkedView& in,
                                            double letters_mm, std::span<const PaperBox> taken,
                                            Marks& marks) {
  const ViewPaper paper(in);
  if (!paper.good()) return std::nullopt;
  const SideOnPaper side = side_on_paper(neighbour, paper);
  const auto line = line_of(neighbour, in, paper, side);
  // Where the two have no more in common than a corner there is nothing to go on with.
  if (!line || length_of(*line) < 1) return std::nullopt;
  marks.paths.push_back({LineClass::match_line, {rounded(line->a), rounded(line->b)}, false});
  std::string words = "MATCH LINE, SEE VIEW " + on_one_line(neighbour.title);
  if (neighbour.sheets_on != 0)
    words += ", SHEET " +
             std::to_string(static_cast<std::ptrdiff_t>(sheet_number) + neighbour.sheets_on);
  marks.texts.push_back(text_beside(std::move(words), *line, side, letters_mm, taken));
  return line;
}

void clear_below(const PaperSegment& match_line, PlacedView& view) {
  const AlongLine on(match_line);
  std::erase_if(view.ink.break_lines, [&](const drawing::BreakLine& line) {
    // They go on beyond what they cross.
    constexpr double kBreakBeyondMm = 2;
    return std::ranges::all_of(std::array{line.points.front(), line.points.back()},
                               [&](const PaperPoint& p) {
                                 return on.holds(p) && on.at(p) >= -kBreakBeyondMm &&
                                        on.at(p) <= on.length() + kBreakBeyondMm;
                               });
  });
  std::vector<Path> left;
  for (const Path& path : view.grid.paths)
    std::ranges::move(beside(path, match_line, on), std::back_inserter(left));
  view.grid.paths = std::move(left);
}

}  // namespace strake::sheets
