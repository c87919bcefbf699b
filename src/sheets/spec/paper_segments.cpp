// SPDX-License-Identifier: Apache-2.0
#include "sheets/spec/paper_segments.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/numeric/trig.hpp"

namespace strake::sheets {

namespace {

/// Returns twice the area of a triangle, positive where it is counter-clockwise.
double doubled_area(const PaperPoint& a, const PaperPoint& b, const PaperPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Returns whether two points lie on different sides of a line, and neither on it.
bool separates(const PaperSegment& line, const PaperSegment& ends) {
  const double a = doubled_area(line.a, line.b, ends.a), b = doubled_area(line.a, line.b, ends.b);
  return (a < 0 && b > 0) || (a > 0 && b < 0);
}

}  // namespace

double length_of(const PaperSegment& segment) {
  const double dx = segment.b.x - segment.a.x, dy = segment.b.y - segment.a.y;
  return std::sqrt(dx * dx + dy * dy);
}

std::optional<PaperSegment> clipped(const PaperSegment& segment, const PaperBox& box) {
  const auto& [a, b] = segment;
  const double dx = b.x - a.x, dy = b.y - a.y;
  double from = 0, to = 1;
  // A side of the box lies `space` before the point a, and the segment runs `step` towards it.
  struct Side {
    double step, space;
  };
  for (const Side& side : std::array<Side, 4>{{{-dx, a.x - box.left},
                                               {dx, box.right - a.x},
                                               {-dy, a.y - box.top},
                                               {dy, box.bottom - a.y}}}) {
    if (side.step == 0 && side.space < 0) return std::nullopt;
    if (side.step < 0) from = std::max(from, side.space / side.step);
    if (side.step > 0) to = std::min(to, side.space / side.step);
  }
  if (from > to) return std::nullopt;
  return PaperSegment{{a.x + dx * from, a.y + dy * from}, {a.x + dx * to, a.y + dy * to}};
}

PaperPoint reading_way(const PaperPoint& way) {
  constexpr double kLevel = 1e-9;
  if (std::fabs(way.y) < kLevel) return {1, 0};
  if (std::fabs(way.x) < kLevel) return {0, -1};
  return way.x > 0 ? way : PaperPoint{-way.x, -way.y};
}

double reading_turn(const PaperPoint& way) {
  const double turn = geometry::arc_tan2(-way.y, way.x) * 180 / geometry::kPi;
  // A millionth of a degree is less than a micrometre of any text.
  return std::round(turn * 1e6) / 1e6 + 0.0;
}

bool segments_cross(const PaperSegment& one, const PaperSegment& other) {
  return separates(one, other) && separates(other, one);
}

}  // namespace strake::sheets
