// SPDX-License-Identifier: Apache-2.0
#include "drawing/duplicates.hpp"

#include <utility>

#include "drawing/overlaps.hpp"

namespace strake::drawing {

namespace {

using geometry::Vec3d;

Rank rank_of(LineState state) {
  if (state == LineState::visible) return Rank::visible;
  return is_hidden(state) ? Rank::hidden : Rank::none;
}

std::vector<Flat> flatten(const std::vector<Line>& lines, const PaperAxes& axes,
                          double distance_mm) {
  std::vector<Flat> flat(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    // Relative to the first line: far from the origin differences keep their digits.
    const Vec3d a = lines[i].a_mm - lines[0].a_mm, b = lines[i].b_mm - lines[0].a_mm;
    Flat& f = flat[i];
    f = Flat(dot(axes.right, a), dot(axes.up, a), dot(axes.right, b), dot(axes.up, b));
    f.depth = dot(axes.toward, a) + dot(axes.toward, b);
    f.reach = distance_mm / 2;
    f.rank = f.length > 0 ? rank_of(lines[i].state) : Rank::none;
  }
  return flat;
}

PaperPoint between(const PaperPoint& a, const PaperPoint& b, double t) {
  return {rounded_paper(a.x + (b.x - a.x) * t), rounded_paper(a.y + (b.y - a.y) * t)};
}

}  // namespace

bool is_hidden(LineState state) {
  return state == LineState::hidden_by_self || state == LineState::hidden_by_other;
}

Line part_of(const Line& line, double from, double to) {
  Line part = line;
  const auto at = [&](double t) {
    // The grid's micrometre: more digits would say nothing.
    return Vec3d{rounded_paper(line.a_mm.x + (line.b_mm.x - line.a_mm.x) * t),
                 rounded_paper(line.a_mm.y + (line.b_mm.y - line.a_mm.y) * t),
                 rounded_paper(line.a_mm.z + (line.b_mm.z - line.a_mm.z) * t)};
  };
  if (from > 0) {
    part.a_mm = at(from);
    part.a_paper = between(line.a_paper, line.b_paper, from);
  }
  if (to < 1) {
    part.b_mm = at(to);
    part.b_paper = between(line.a_paper, line.b_paper, to);
  }
  return part;
}

Result<std::vector<Line>> mark_duplicates(std::vector<Line> lines, const PaperAxes& axes,
                                          double distance_mm, const parallel::Context& context) {
  const auto stretches = cut_overlaps(flatten(lines, axes, distance_mm),
                                      {.least = distance_mm, .shortest = distance_mm}, context);
  if (!stretches) return stretches.error();
  std::vector<Line> out;
  out.reserve(stretches->size());
  for (const Stretch& s : *stretches) {
    out.push_back(part_of(lines[s.line], s.from, s.to));
    if (s.covered) out.back().state = LineState::duplicate;
  }
  return out;
}

}  // namespace strake::drawing
