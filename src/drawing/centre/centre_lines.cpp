// SPDX-License-Identifier: Apache-2.0
#include "strake/drawing/centre_lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/units.hpp"
#include "drawing/centre/axes.hpp"
#include "drawing/layout/view_plane.hpp"
#include "strake/parallel/collect.hpp"

namespace strake::drawing {

namespace {

/// Lines no farther apart than this, mm, are in line; so are circles about one centre.
constexpr double kInLine = 0.05;

/// Counts cells of a width; their rims lie off the round numbers that coordinates often are.
std::int64_t cell(double value, double width) { return std::llround(value / width + 0.137); }

/// A circle that is seen head-on, and how much of it has ink.
struct VisibleCircle {
  PaperPoint centre;
  double radius = 0;
  model::ObjectId object{};
};

bool is_round(const PaperCurve& c) {
  const double u = c.u.x * c.u.x + c.u.y * c.u.y, v = c.v.x * c.v.x + c.v.y * c.v.y;
  return std::fabs(u - v) <= 1e-3 * u && std::fabs(c.u.x * c.v.x + c.u.y * c.v.y) <= 1e-3 * u;
}

double length_on_paper(const Line& line) {
  const double x = line.b_paper.x - line.a_paper.x, y = line.b_paper.y - line.a_paper.y;
  return std::sqrt(x * x + y * y);
}

/// Returns the circles that are seen head-on with half of their way or more, the largest about
/// each centre.
std::vector<VisibleCircle> visible_circles(const NeutralDrawing& drawing, const Ink& ink,
                                           double least) {
  std::vector<double> length(drawing.curves.all.size());
  std::vector<model::ObjectId> object(length.size());
  for (const Line& line : ink.lines) {
    const std::uint32_t curve = drawing.curves.index_of(line);
    if (curve == PaperCurves::kNone) continue;
    if (length[curve] == 0) object[curve] = line.object;
    length[curve] += length_on_paper(line);
  }
  std::vector<VisibleCircle> circles;
  for (std::size_t c = 0; c < length.size(); ++c) {
    const PaperCurve& curve = drawing.curves.all[c];
    const double radius = std::sqrt(curve.u.x * curve.u.x + curve.u.y * curve.u.y);
    constexpr double kHalfTurn = 3;
    if (2 * radius >= least && is_round(curve) && length[c] >= kHalfTurn * radius)
      circles.push_back({curve.centre, radius, object[c]});
  }
  const auto place = [](const VisibleCircle& c) {
    return std::tuple(cell(c.centre.x, kInLine), cell(c.centre.y, kInLine));
  };
  std::ranges::sort(circles, [&](const VisibleCircle& a, const VisibleCircle& b) {
    return std::tuple(place(a), -a.radius, a.object, a.centre.x, a.centre.y) <
           std::tuple(place(b), -b.radius, b.object, b.centre.x, b.centre.y);
  });
  const auto rest = std::ranges::unique(circles, {}, place);
  circles.erase(rest.begin(), rest.end());
  return circles;
}

void add_cross(const VisibleCircle& circle, std::vector<AxisPart>& parts) {
  const auto& [x, y] = circle.centre;
  const double r = circle.radius, over = overhang_mm(2 * r);
  parts.push_back({{x - r, y}, {x + r, y}, over, over, circle.object, true, 0});
  parts.push_back({{x, y - r}, {x, y + r}, over, over, circle.object, true, 0});
}

/// A part of an axis by the line on which it lies.
struct InLine {
  std::int64_t angle = 0, offset = 0;
  double from = 0, to = 0;  ///< along the line, with the overhangs
  PaperPoint unit, foot;    ///< points of the line are foot + unit * t
  model::ObjectId object{};
  bool cross = false;
};

InLine in_line(const AxisPart& part) {
  double x = part.b.x - part.a.x, y = part.b.y - part.a.y;
  const double length = std::sqrt(x * x + y * y);
  x /= length;
  y /= length;
  double before = part.before_mm, after = part.after_mm;
  PaperPoint a = part.a;
  // A line to the left is the same as one to the right; the vertical ones go down.
  if (x < -1e-9 || (x < 1e-9 && y < 0)) {
    x = -x;
    y = -y;
    a = part.b;
    std::swap(before, after);
  }
  const double along = a.x * x + a.y * y, offset = a.y * x - a.x * y;
  constexpr double kSameWay = 1e-4;
  return {cell(y, kSameWay),
          cell(offset, kInLine),
          along - before,
          along + length + after,
          {x, y},
          {-y * offset, x * offset},
          part.object,
          part.cross};
}

CentreLine line_of(const InLine& line) {
  const auto at = [&](double t) {
    return PaperPoint{rounded_paper(line.foot.x + line.unit.x * t),
                      rounded_paper(line.foot.y + line.unit.y * t)};
  };
  return {line.object, {at(line.from), at(line.to)}, line.cross};
}

/// Makes one line of the parts that lie in line and meet with their overhangs.
void join_in_line(std::span<const AxisPart> parts, std::vector<CentreLine>& out) {
  std::vector<InLine> all;
  for (const AxisPart& part : parts) all.push_back(in_line(part));
  std::ranges::sort(all, {}, [](const InLine& l) {
    return std::tuple(l.angle, l.offset, l.from, l.to, l.object, l.cross);
  });
  for (std::size_t i = 0; i < all.size();) {
    InLine joined = all[i];
    std::size_t k = i + 1;
    for (; k < all.size() && all[k].angle == joined.angle && all[k].offset == joined.offset &&
           all[k].from <= joined.to + kInLine;
         ++k) {
      // The arm of a cross has the place of its middle to mind; a longer line has not.
      joined.cross = joined.cross && all[k].from == joined.from && all[k].to == joined.to;
      joined.to = std::max(joined.to, all[k].to);
      joined.object = std::min(joined.object, all[k].object);
    }
    out.push_back(line_of(joined));
    i = k;
  }
}

/// Takes the overhangs off ends at which a bend goes on.
void end_at_bends(Axes2d& axes) {
  std::vector<std::pair<double, double>> ends;
  for (const BendPart& bend : axes.bends)
    for (const PaperPoint& p : {bend.points.front(), bend.points.back()})
      ends.emplace_back(p.x, p.y);
  std::ranges::sort(ends);
  const auto meets = [&](const PaperPoint& p) {
    auto end = std::ranges::lower_bound(ends, std::pair(p.x - kInLine, -1e300));
    for (; end != ends.end() && end->first <= p.x + kInLine; ++end)
      if (std::fabs(end->second - p.y) <= kInLine) return true;
    return false;
  };
  for (AxisPart& part : axes.parts) {
    if (part.cross) continue;
    if (meets(part.a)) part.before_mm = 0;
    if (meets(part.b)) part.after_mm = 0;
  }
}

}  // namespace

Result<std::optional<CentreLineOptions>> parse_centre_lines(std::string_view text) {
  if (text == "off") return std::optional<CentreLineOptions>();
  if (text == "on") return std::optional(CentreLineOptions{});
  const Result<double> least = parse_distance_mm(text);
  if (!least || !(*least > 0 && *least <= 1000))
    return Error{ErrorCode::usage,
                 "'" + std::string(text) + "' is no least diameter on paper",
                 {},
                 "write on, off, or a diameter from which round parts have centre lines, as 4mm"};
  return std::optional(CentreLineOptions{*least});
}

Result<std::vector<CentreLine>> find_centre_lines(const NeutralDrawing& drawing, const Ink& ink,
                                                  const model::Model& model,
                                                  const CentreLineOptions& options,
                                                  const parallel::Context& context) {
  std::vector<CentreLine> found;
  const auto plane = paper_axes(drawing.view);
  if (!plane || plane->eye || ink.lines.empty()) return found;
  const OrthographicPaper paper(*plane, drawing.sheet.scale, ink.lines.front());
  auto some = parallel::collect<Axes2d>(
      context, {.name = "centre lines", .n = ink.lines.size(), .grain = 4096},
      [&](std::size_t first, std::vector<Axes2d>& out) {
        const model::ObjectId object = ink.lines[first].object;
        if (first > 0 && ink.lines[first - 1].object == object) return;
        std::size_t end = first + 1;
        while (end < ink.lines.size() && ink.lines[end].object == object) ++end;
        Axes2d axes;
        find_axes(model, std::span(ink.lines).subspan(first, end - first), paper,
                  options.min_diameter_mm, axes);
        if (!axes.parts.empty() || !axes.bends.empty()) out.push_back(std::move(axes));
      });
  if (!some) return some.error();
  Axes2d axes;
  for (Axes2d& of_object : *some) {
    std::ranges::move(of_object.parts, std::back_inserter(axes.parts));
    std::ranges::move(of_object.bends, std::back_inserter(axes.bends));
  }
  for (const VisibleCircle& circle : visible_circles(drawing, ink, options.min_diameter_mm))
    add_cross(circle, axes.parts);
  end_at_bends(axes);
  join_in_line(axes.parts, found);
  for (BendPart& bend : axes.bends) {
    for (PaperPoint& p : bend.points) p = {rounded_paper(p.x), rounded_paper(p.y)};
    found.push_back({bend.object, std::move(bend.points), false});
  }
  return found;
}

}  // namespace strake::drawing
