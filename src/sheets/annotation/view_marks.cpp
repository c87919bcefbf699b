// SPDX-License-Identifier: Apache-2.0
#include "sheets/annotation/view_marks.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "drawing/layout/view_plane.hpp"
#include "sheets/arrangement/view_margins.hpp"
#include "sheets/spec/paper_segments.hpp"
#include "sheets/spec/text_metrics.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::sheets {

namespace {

using drawing::rounded_paper;
using geometry::Vec3d;

/// How long the arrows of a cutting plane are and their heads, mm.
constexpr double kArrowMm = 9, kHeadMm = 3;

/// The ends of a cutting plane: which way the plane runs out of the view and in which direction the
/// section is seen, and its letter.
struct PlaneEnds {
  PaperPoint arrow;
  const std::string& letter;
  double letters_mm;
};

/// Returns an end of a cutting plane: its wide part, its arrow and its letter. `out` points away
/// from the view along the plane.
Marks end_of_plane(const PlaneEnds& ends, const PaperPoint& end, const PaperPoint& out) {
  const auto& [arrow, letter, letters_mm] = ends;
  Marks marks;
  marks.paths.push_back(
      {LineClass::section, {rounded(end), rounded(along(end, out, -kWideEndMm))}, false});
  // The arrow stands on the end and points at it.
  const PaperPoint tail = along(end, arrow, -kArrowMm), neck = along(end, arrow, -kHeadMm);
  marks.paths.push_back({LineClass::note, {rounded(tail), rounded(neck)}, false});
  marks.paths.push_back({LineClass::note,
                         {rounded(end), rounded(along(neck, out, kHeadMm / 4)),
                          rounded(along(neck, out, -kHeadMm / 4)), rounded(end)},
                         true});
  const PaperPoint middle = along(tail, arrow, -0.8 * letters_mm);
  marks.texts.push_back({LineClass::title, rounded({middle.x, middle.y + letters_mm / 2}),
                         letters_mm, Align::middle, letter, true});
  return marks;
}

/// The box in which a cutting plane is drawn, and that of its thin part: on sides with labels it
/// has a gap for them.
struct PlaneReach {
  PaperBox whole, thin;
};

PlaneReach plane_reach(const MarkedView& in) {
  const ViewMargins labels{in.lines.left - in.labelled.left, in.lines.top - in.labelled.top,
                           in.labelled.right - in.lines.right,
                           in.labelled.bottom - in.lines.bottom};
  ViewMargins whole, thin;
  for (const auto side : {&ViewMargins::left_mm, &ViewMargins::top_mm, &ViewMargins::right_mm,
                          &ViewMargins::bottom_mm}) {
    constexpr double kThinMm = 4;
    whole.*side = reach_of_plane(labels.*side);
    thin.*side = labels.*side > kThinMm ? kThinMm : whole.*side;
  }
  return {with_margins(in.lines, whole), with_margins(in.lines, thin)};
}

}  // namespace

std::vector<PaperBox> taken_boxes(const Marks& marks) {
  std::vector<PaperBox> boxes;
  for (const Text& text : marks.texts)
    for (const PaperBox& box : boxes_of(text)) boxes.push_back(box);
  for (const Circle& c : marks.circles)
    boxes.push_back(widened({c.center.x, c.center.y, c.center.x, c.center.y}, c.radius_mm));
  for (const Path& path : marks.paths) {
    if (path.line != LineClass::note && path.line != LineClass::section) continue;
    PaperBox box{path.points[0].x, path.points[0].y, path.points[0].x, path.points[0].y};
    for (const PaperPoint& p : path.points)
      box = {std::min(box.left, p.x), std::min(box.top, p.y), std::max(box.right, p.x),
             std::max(box.bottom, p.y)};
    boxes.push_back(widened(box, 0.5));
  }
  return boxes;
}

namespace {

/// Draws an end of a cutting plane, so far out that it covers nothing of what is taken.
void draw_end(const PlaneEnds& ends, const PaperPoint& end, const PaperPoint& out,
              std::span<const PaperBox> taken, Marks& marks) {
  constexpr int kFarthestMm = 40;
  const auto is_free = [&](const Marks& here) {
    return std::ranges::none_of(taken_boxes(here), [&](const PaperBox& box) {
      return std::ranges::any_of(taken, [&](const PaperBox& t) { return t.overlaps(box); });
    });
  };
  Marks drawn = end_of_plane(ends, end, out);
  for (int away = 1; !is_free(drawn) && away <= kFarthestMm; ++away)
    drawn = end_of_plane(ends, along(end, out, away), out);
  // Where there is no free paper it stands where it belongs.
  if (!is_free(drawn)) drawn = end_of_plane(ends, end, out);
  std::ranges::move(drawn.paths, std::back_inserter(marks.paths));
  std::ranges::move(drawn.texts, std::back_inserter(marks.texts));
}

}  // namespace

bool mark_section(const ViewSpec& cut, const MarkedView& in, double letters_mm, const Marks& grid,
                  Marks& marks) {
  const ViewPaper paper(in);
  if (!paper.good()) return false;
  bool any = false;
  const PlaneReach reach = plane_reach(in);
  const std::vector<PaperBox> labels = taken_boxes(grid);
  for (const hlr::Section& section : cut.view.sections) {
    const Vec3d normal = section.normal.as<double>();
    const double length = std::sqrt(dot(normal, normal));
    if (dot(section.normal, in.spec.view.direction) != 0) continue;
    PaperPoint arrow = paper.vector(normal * (1 / length));
    // Directions of views point to the viewer, who looks the other way.
    if (dot(normal, cut.view.direction.as<double>()) > 0) arrow = {-arrow.x, -arrow.y};
    const PaperPoint way{arrow.y, -arrow.x};
    const PaperPoint on = paper.point(geometry::to_mm(section.point));
    constexpr double kFar = 1e5;
    const PaperSegment plane{along(on, way, -kFar), along(on, way, kFar)};
    if (!clipped(plane, in.lines)) continue;
    const auto line = clipped(plane, reach.whole), thin = clipped(plane, reach.thin);
    if (!line || !thin) continue;
    any = true;
    marks.paths.push_back({LineClass::cutting_plane, {rounded(thin->a), rounded(thin->b)}, false});
    const PlaneEnds ends{arrow, cut.section_mark, letters_mm};
    draw_end(ends, line->a, {-way.x, -way.y}, labels, marks);
    draw_end(ends, line->b, way, labels, marks);
  }
  return any;
}

bool mark_extent(const geometry::Box3d& extent, const std::string& name, const MarkedView& in,
                 double letters_mm, const Marks& grid, Marks& marks) {
  const ViewPaper paper(in);
  if (!paper.good() || extent.empty()) return false;
  std::optional<PaperBox> box;
  for (int corner = 0; corner < 8; ++corner) {
    const PaperPoint p = paper.point({corner % 2 == 0 ? extent.lo.x : extent.hi.x,
                                      corner / 2 % 2 == 0 ? extent.lo.y : extent.hi.y,
                                      corner < 4 ? extent.lo.z : extent.hi.z});
    if (!box) box = PaperBox{p.x, p.y, p.x, p.y};
    *box = {std::min(box->left, p.x), std::min(box->top, p.y), std::max(box->right, p.x),
            std::max(box->bottom, p.y)};
  }
  const PaperPoint a = rounded({box->left, box->top}), b = rounded({box->right, box->bottom});
  marks.paths.push_back({LineClass::extent, {a, {b.x, a.y}, b, {a.x, b.y}, a}, false});
  Text text{LineClass::extent, {a.x, rounded_paper(a.y - 1)},
            letters_mm,        Align::start,
            on_one_line(name), true};
  // Extents that begin at one corner have their names one above the other, and above all labels.
  std::vector<PaperBox> taken = taken_boxes(marks);
  const std::vector<PaperBox> labels = taken_boxes(grid);
  taken.insert(taken.end(), labels.begin(), labels.end());
  const auto covers = [&](const PaperBox& other) { return other.overlaps(box_of(text)); };
  while (std::ranges::any_of(taken, covers))
    text.at.y = rounded_paper(text.at.y - 1.5 * letters_mm);
  marks.texts.push_back(std::move(text));
  return true;
}

}  // namespace strake::sheets
