// SPDX-License-Identifier: Apache-2.0
#include "sheets/annotation/dimensions.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

#include "core/number.hpp"
#include "sheets/spec/paper_segments.hpp"
#include "sheets/spec/text_metrics.hpp"

namespace strake::sheets {

namespace {

using Side = DimensionEnd::Side;

constexpr double kValueMm = 2.5, kArrowLengthMm = 2.5, kArrowWidthMm = 0.8, kStandOffMm = 1,
                 kPastLineMm = 2;

Error fault_of_dimension(std::string message) {
  return {ErrorCode::input, std::move(message), {}, {}};
}

/// Returns the number of the object of that id, or else of that name.
Result<std::uint32_t> object_called(const model::Model& model, const std::string& text) {
  std::optional<std::uint32_t> named;
  bool several = false;
  for (std::uint32_t o = 0; o < model.objects.size(); ++o) {
    if (model.objects[o].id == text) return o;
    if (model.objects[o].name != text) continue;
    several = several || named;
    named = o;
  }
  if (!named) return fault_of_dimension("no object is called '" + text + "'");
  if (several)
    return fault_of_dimension("several objects are called '" + text + "': give the id of one");
  return *named;
}

/// An end on paper, and the box of its object there; a point has a box of its own.
struct EndOnPaper {
  PaperPoint at;
  PaperBox box;
};

bool is_axis_parallel(const hlr::View& view) {
  const auto axes = [](const geometry::Vec3l& v) {
    return (v.x != 0 ? 1 : 0) + (v.y != 0 ? 1 : 0) + (v.z != 0 ? 1 : 0);
  };
  return axes(view.direction) == 1 && axes(view.up) == 1;
}

Result<EndOnPaper> end_on_paper(const DimensionEnd& end, const model::Scene& scene,
                                const MarkedView& in, const ViewPaper& paper) {
  if (end.object.empty()) {
    const PaperPoint p = paper.point(geometry::to_mm(end.point));
    return EndOnPaper{p, {p.x, p.y, p.x, p.y}};
  }
  const Result<std::uint32_t> object = object_called(*scene.model, end.object);
  if (!object) return object.error();
  // Only there a box in the model is the box on paper.
  if (!is_axis_parallel(in.spec.view))
    return fault_of_dimension("the view '" + in.spec.name +
                              "' looks along no axis of the model: give points, not objects");
  auto box = geometry::empty_box<std::int64_t>();
  for (const model::GridBody& body : scene.bodies_of(model::ObjectId{*object}))
    box.include(body.box(scene.shapes[body.grid_shape]));
  if (box.empty()) return fault_of_dimension("the object '" + end.object + "' has no geometry");
  const PaperPoint a = paper.point(geometry::to_mm(box.lo)),
                   b = paper.point(geometry::to_mm(box.hi));
  const PaperBox on{std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.x, b.x), std::max(a.y, b.y)};
  PaperPoint at{(on.left + on.right) / 2, (on.top + on.bottom) / 2};
  if (end.side == Side::left) at.x = on.left;
  if (end.side == Side::right) at.x = on.right;
  if (end.side == Side::top) at.y = on.top;
  if (end.side == Side::bottom) at.y = on.bottom;
  return EndOnPaper{at, end.side == Side::centre ? PaperBox{at.x, at.y, at.x, at.y} : on};
}

/// Returns a value, mm, rounded to the precision of the model or to so many decimals.
std::string value_text(double mm, int decimals) {
  return decimals < 0 ? shortest(std::round(mm * 1000) / 1000) : fixed(mm, decimals);
}

/// The line of a dimension from a to b, with `way` from one to the other and `off` away from what
/// it measures.
struct DimensionLine {
  PaperPoint a, b, way, off;
  double length = 0;
};

void draw_arrow(const PaperPoint& tip, const PaperPoint& from, Marks& marks) {
  const PaperPoint neck = along(tip, from, kArrowLengthMm), aside{-from.y, from.x};
  marks.paths.push_back({LineClass::dimension,
                         {rounded(tip), rounded(along(neck, aside, kArrowWidthMm / 2)),
                          rounded(along(neck, aside, -kArrowWidthMm / 2)), rounded(tip)},
                         true});
}

/// Returns the text of a dimension, which stands on its line (ISO 129-1), or on the line beyond an
/// arrow where it is wider than what it measures. `beyond` is how far the line goes on behind its
/// arrows.
Text text_of_dimension(const DimensionLine& line, const std::string& value, double beyond) {
  const PaperPoint way = reading_way(line.way), up{way.y, -way.x};
  PaperPoint at{(line.a.x + line.b.x) / 2, (line.a.y + line.b.y) / 2};
  Align align = Align::middle;
  if (text_width(value) * kValueMm > line.length) {
    const bool forward = way.x * line.way.x + way.y * line.way.y > 0;
    at = along(forward ? line.b : line.a, way, std::max(beyond, kStandOffMm));
    align = Align::start;
  }
  return {LineClass::dimension, rounded(along(at, up, kStandOffMm)), kValueMm, align, value, true,
          reading_turn(way)};
}

void draw_line(const DimensionLine& line, const std::string& value, Marks& marks) {
  const PaperPoint back{-line.way.x, -line.way.y};
  const bool narrow = line.length < 2 * kArrowLengthMm + 1;
  const double beyond = narrow ? 2 * kArrowLengthMm : 0;
  const PaperPoint a = along(line.a, back, beyond), b = along(line.b, line.way, beyond);
  marks.paths.push_back({LineClass::dimension, {rounded(a), rounded(b)}, false});
  draw_arrow(line.a, narrow ? back : line.way, marks);
  draw_arrow(line.b, narrow ? line.way : back, marks);
  marks.texts.push_back(text_of_dimension(line, value, beyond));
}

/// Draws the extension line from an end to the line of the dimension and a little beyond.
void draw_extension(const PaperPoint& from, const PaperPoint& to, const PaperPoint& off,
                    Marks& marks) {
  const double gap = (to.x - from.x) * off.x + (to.y - from.y) * off.y;
  if (!(gap > kStandOffMm)) return;
  marks.paths.push_back(
      {LineClass::dimension,
       {rounded(along(from, off, kStandOffMm)), rounded(along(to, off, kPastLineMm))},
       false});
}

}  // namespace

Status draw_dimension(const DimensionSpec& spec, const model::Scene& scene, const MarkedView& in,
                      Marks& marks) {
  const ViewPaper paper(in);
  if (!paper.good())
    return fault_of_dimension("the view '" + in.spec.name +
                              "' is in perspective: nothing can be measured in it");
  const auto from = end_on_paper(spec.from, scene, in, paper),
             to = end_on_paper(spec.to, scene, in, paper);
  if (!from) return from.error();
  if (!to) return to.error();
  DimensionLine line{from->at, to->at, {}, {}, 0};
  PaperPoint first = from->at, second = to->at;
  const double sign = spec.other_side ? 1 : -1;
  if (spec.along == DimensionSpec::Along::horizontal) {
    line.off = {0, sign};
    line.a.y = line.b.y =
        (spec.other_side ? in.lines.bottom : in.lines.top) + sign * spec.offset_mm;
    first.y = spec.other_side ? from->box.bottom : from->box.top;
    second.y = spec.other_side ? to->box.bottom : to->box.top;
  } else if (spec.along == DimensionSpec::Along::vertical) {
    line.off = {sign, 0};
    line.a.x = line.b.x =
        (spec.other_side ? in.lines.right : in.lines.left) + sign * spec.offset_mm;
    first.x = spec.other_side ? from->box.right : from->box.left;
    second.x = spec.other_side ? to->box.right : to->box.left;
  }
  const double dx = line.b.x - line.a.x, dy = line.b.y - line.a.y;
  line.length = std::sqrt(dx * dx + dy * dy);
  if (!(line.length > 1e-6))
    return fault_of_dimension("its two ends lie on each other in the view '" + in.spec.name + "'");
  line.way = {dx / line.length, dy / line.length};
  if (spec.along == DimensionSpec::Along::aligned) {
    line.off = {-line.way.y, line.way.x};
    if ((line.off.y > 0) != spec.other_side) line.off = {line.way.y, -line.way.x};
    line.a = along(line.a, line.off, spec.offset_mm);
    line.b = along(line.b, line.off, spec.offset_mm);
  }
  draw_extension(first, line.a, line.off, marks);
  draw_extension(second, line.b, line.off, marks);
  draw_line(line, value_text(paper.in_model(line.length), spec.decimals), marks);
  return {};
}

}  // namespace strake::sheets
