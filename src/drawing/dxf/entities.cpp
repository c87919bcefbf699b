// SPDX-License-Identifier: Apache-2.0
#include "drawing/dxf/entities.hpp"

#include "drawing/dxf/handles.hpp"
#include "drawing/dxf/layer_style.hpp"

namespace strake::drawing::dxf {

namespace {

void append_pen(Groups& groups, const EntityPen& pen) {
  groups.whole(62, color_number(pen.color));
  if (pen.width_mm > 0) groups.whole(370, line_weight(pen.width_mm));
  // True black would not be seen on black: number 7 shows white there.
  const std::int64_t color = std::int64_t{pen.color.red} * 0x10000 +
                             std::int64_t{pen.color.green} * 0x100 + pen.color.blue;
  if (color != 0) groups.whole(420, color);
}

Groups begin(std::string& out, std::string_view type, const EntityHead& head,
             std::string_view subclass) {
  Groups groups(out);
  groups.text(0, type).handle(5, head.handle);
  const bool on_paper = head.space == Space::paper;
  const Handle paper = head.paper != 0 ? head.paper : kPaperSpace;
  groups.handle(330, on_paper ? paper : kModelSpace).text(100, "AcDbEntity");
  if (on_paper) groups.whole(67, 1);
  groups.text(8, head.layer);
  if (head.dash_stretch == 0)
    groups.text(6, "Continuous");
  else if (head.dash_stretch != 1)
    groups.number(48, head.dash_stretch);
  if (head.pen) append_pen(groups, *head.pen);
  return groups.text(100, subclass);
}

}  // namespace

void append_line(std::string& out, const EntityHead& head, const PaperPoint& a,
                 const PaperPoint& b) {
  begin(out, "LINE", head, "AcDbLine").point_in_space(10, a.x, a.y).point_in_space(11, b.x, b.y);
}

void append_polyline(std::string& out, const EntityHead& head, std::span<const PaperPoint> points,
                     bool dashed) {
  constexpr int kClosed = 1, kDashesGoOn = 128;
  const bool closed = points.size() > 3 && points.front() == points.back();
  if (closed) points = points.first(points.size() - 1);
  Groups groups = begin(out, "LWPOLYLINE", head, "AcDbPolyline");
  groups.whole(90, static_cast<std::int64_t>(points.size()))
      .whole(70, (closed ? kClosed : 0) + (dashed ? kDashesGoOn : 0));
  for (const PaperPoint& point : points) groups.point(10, point.x, point.y);
}

void append_circle(std::string& out, const EntityHead& head, const PaperPoint& centre,
                   double radius) {
  begin(out, "CIRCLE", head, "AcDbCircle")
      .point_in_space(10, centre.x, centre.y)
      .number(40, radius);
}

void append_arc(std::string& out, const EntityHead& head, const PaperPoint& centre, double radius,
                double from_deg, double to_deg) {
  begin(out, "ARC", head, "AcDbCircle")
      .point_in_space(10, centre.x, centre.y)
      .number(40, radius)
      .text(100, "AcDbArc")
      .number(50, from_deg)
      .number(51, to_deg);
}

void append_ellipse(std::string& out, const EntityHead& head, const PaperPoint& centre,
                    const PaperPoint& major, double ratio, double from_rad, double to_rad) {
  begin(out, "ELLIPSE", head, "AcDbEllipse")
      .point_in_space(10, centre.x, centre.y)
      .point_in_space(11, major.x, major.y)
      .number(40, ratio)
      .number(41, from_rad)
      .number(42, to_rad);
}

void append_text(std::string& out, const EntityHead& head, const TextPlace& place,
                 std::string_view text) {
  constexpr int kBackward = 2;
  const PaperPoint& at = place.at;
  Groups groups = begin(out, "TEXT", head, "AcDbText");
  groups.point_in_space(10, at.x, at.y).number(40, place.height).text(1, shown_text(text));
  if (place.turn_deg != 0) groups.number(50, place.turn_deg);
  if (place.stretch != 1) groups.number(41, place.stretch);
  if (place.lean_deg != 0) groups.number(51, place.lean_deg);
  groups.text(7, kTextStyle);
  if (place.mirrored) groups.whole(71, kBackward);
  if (place.align != TextAlign::start)
    groups.whole(72, place.align == TextAlign::middle ? 1 : 2).point_in_space(11, at.x, at.y);
  groups.text(100, "AcDbText");
}

void append_filled(std::string& out, const EntityHead& head, std::span<const PaperPoint> points) {
  constexpr int kOuterPolyline = 3;
  Groups groups = begin(out, "HATCH", head, "AcDbHatch");
  groups.point_in_space(10, 0, 0)
      .point(210, 0, 0)
      .whole(230, 1)
      .text(2, "SOLID")
      .whole(70, 1)
      .whole(71, 0)
      .whole(91, 1)
      .whole(92, kOuterPolyline)
      .whole(72, 0)
      .whole(73, 1)
      .whole(93, static_cast<std::int64_t>(points.size()));
  for (const PaperPoint& point : points) groups.point(10, point.x, point.y);
  groups.whole(97, 0).whole(75, 0).whole(76, 1).whole(98, 0);
}

void append_cover(std::string& out, const EntityHead& head, const CoverCorners& corners) {
  const auto& [low, right, up] = corners;
  // An image of one dot, as large as the area and clipped by its own rim.
  constexpr int kShownClippedWithAll = 7;
  begin(out, "WIPEOUT", head, "AcDbWipeout")
      .whole(90, 0)
      .point_in_space(10, low.x, low.y)
      .point_in_space(11, right.x - low.x, right.y - low.y)
      .point_in_space(12, up.x - low.x, up.y - low.y)
      .point(13, 1, 1)
      .handle(340, 0)
      .whole(70, kShownClippedWithAll)
      .whole(280, 1)
      .whole(281, 50)
      .whole(282, 50)
      .whole(283, 0)
      .handle(360, 0)
      .whole(71, 1)
      .whole(91, 2)
      .point(14, -0.5, 0.5)
      .point(14, 0.5, -0.5);
}

void append_viewport(std::string& out, const EntityHead& head, const Viewport& viewport,
                     int number) {
  // The scale of what is shown cannot be changed by accident, and no icon of axes stands in it.
  constexpr int kLocked = 0x4000, kFastZoom = 0x80, kAlwaysFast = 0x8000;
  begin(out, "VIEWPORT", head, "AcDbViewport")
      .point_in_space(10, viewport.centre.x, viewport.centre.y)
      .number(40, viewport.width)
      .number(41, viewport.height)
      .whole(68, number)
      .whole(69, number)
      .point(12, viewport.target.x, viewport.target.y)
      .point(13, 0, 0)
      .point(14, 10, 10)
      .point(15, 10, 10)
      .point(16, 0, 0)
      .whole(36, 1)
      .point_in_space(17, 0, 0)
      .whole(42, 50)
      .whole(43, 0)
      .whole(44, 0)
      .number(45, viewport.height_in_model)
      .whole(50, 0)
      .whole(51, 0)
      .whole(72, 1000)
      .whole(90, kAlwaysFast + kFastZoom + (number > 1 ? kLocked : 0))
      .text(1, "")
      .whole(281, 0)
      .whole(71, 0)
      .whole(74, 0)
      .point_in_space(110, 0, 0)
      .point_in_space(111, 1, 0)
      .point_in_space(112, 0, 1)
      .whole(79, 0)
      .whole(146, 0);
}

}  // namespace strake::drawing::dxf
