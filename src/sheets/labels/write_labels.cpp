// SPDX-License-Identifier: Apache-2.0
#include "sheets/labels/write_labels.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include "drawing/layout/view_plane.hpp"
#include "sheets/labels/label_placement.hpp"
#include "sheets/labels/paper/occupancy_grid.hpp"
#include "sheets/spec/text_metrics.hpp"

namespace strake::sheets {

namespace {

using drawing::Line;
using drawing::rounded_paper;

/// How long the arrow of a balloon is.
constexpr double kBalloonArrowMm = 2.5;

LabelRequest request_of(const TagList& list, const TaggedObject& tagged) {
  return {.width_mm = text_width(tagged.text) * list.spec->height_mm,
          .height_mm = list.spec->height_mm,
          .anchors = anchors_of(tagged.seen.longest),
          .object = tagged.seen.box,
          .on_object = !list.spec->leader,
          .view = list.view};
}

/// Returns the paper that views, their captions, frames and grid lines take.
OccupancyGrid occupied_paper(const Sheet& sheet) {
  OccupancyGrid occupied(sheet.width_mm, sheet.height_mm);
  for (const PlacedView& view : sheet.views) {
    for (const Line& line : view.ink.lines) occupied.add_line(line.a_paper, line.b_paper);
    for (const drawing::CentreLine& line : view.ink.centre_lines)
      for (std::size_t i = 1; i < line.points.size(); ++i)
        occupied.add_line(line.points[i - 1], line.points[i]);
    for (const drawing::BreakLine& line : view.ink.break_lines)
      for (std::size_t i = 1; i < line.points.size(); ++i)
        occupied.add_line(line.points[i - 1], line.points[i]);
    for (const Marks* marks : {&view.caption, &view.grid, &view.frame, &view.notes}) {
      for (const Path& path : marks->paths)
        for (std::size_t i = 1; i < path.points.size(); ++i)
          occupied.add_line(path.points[i - 1], path.points[i]);
      for (const Text& text : marks->texts)
        for (const PaperBox& box : boxes_of(text)) occupied.block(box);
      for (const Circle& c : marks->circles)
        occupied.block({c.center.x - c.radius_mm, c.center.y - c.radius_mm,
                        c.center.x + c.radius_mm, c.center.y + c.radius_mm});
    }
  }
  occupied.finish();
  return occupied;
}

/// Returns the arrow head at the end of a leader: as long as the letters are high, a third as wide.
Path arrow(const PaperSegment& leader, double height_mm) {
  const auto& [tip, from] = leader;
  const double dx = from.x - tip.x, dy = from.y - tip.y;
  const double length = std::sqrt(dx * dx + dy * dy);
  const double x = dx / length * height_mm, y = dy / length * height_mm;
  const PaperPoint left{rounded_paper(tip.x + x - y / 6), rounded_paper(tip.y + y + x / 6)};
  const PaperPoint right{rounded_paper(tip.x + x + y / 6), rounded_paper(tip.y + y - x / 6)};
  return {LineClass::leader, {tip, left, right, tip}, true};
}

void write_tag(const std::string& text, double height_mm, const LabelPlace& place, Marks& marks) {
  marks.texts.push_back({LineClass::leader, place.at, height_mm, place.align, text, true});
  if (!place.has_leader) return;
  marks.paths.push_back({LineClass::leader, {place.leader.a, place.leader.b, place.end}, false});
  marks.paths.push_back(arrow(place.leader, height_mm));
}

LabelRequest request_of(const BalloonList& list, const Balloon& balloon, const Sheet& sheet) {
  const BalloonSpec& spec = *list.spec->balloons;
  LabelRequest request{.width_mm = spec.diameter_mm,
                       .height_mm = spec.diameter_mm,
                       .anchors = anchors_of(balloon.seen.longest),
                       .object = balloon.seen.box,
                       .view = balloon.view,
                       .balloon = true};
  if (spec.side != BalloonSpec::Side::anywhere)
    request.within = paper_beside(sheet.views[balloon.view].box, spec.side, sheet);
  return request;
}

void write_balloon(const BalloonList& list, const std::string& number, const LabelPlace& place,
                   Marks& marks) {
  marks.circles.push_back({LineClass::leader, place.at, list.spec->balloons->diameter_mm / 2});
  marks.texts.push_back({LineClass::leader,
                         {place.at.x, rounded_paper(place.at.y + list.letters_mm / 2)},
                         list.letters_mm,
                         Align::middle,
                         number,
                         false});
  marks.paths.push_back({LineClass::leader, {place.leader.a, place.leader.b}, false});
  marks.paths.push_back(arrow(place.leader, kBalloonArrowMm));
}

}  // namespace

Status write_labels(SheetLabels& labels, const SheetArea& room, Sheet& sheet,
                    const std::stop_token& stop) {
  std::vector<LabelRequest> requests;
  for (const TagList& list : labels.tags)
    for (const TaggedObject& tagged : list.objects) requests.push_back(request_of(list, tagged));
  for (const BalloonList& list : labels.balloons)
    for (const Balloon& balloon : list.all) requests.push_back(request_of(list, balloon, sheet));
  const OccupancyGrid occupied = occupied_paper(sheet);
  LabelGround ground{sheet.width_mm, sheet.height_mm, occupied, room, {}};
  for (const PlacedView& view : sheet.views) ground.views.push_back(view.box);
  const auto places = place_labels(requests, ground, stop);
  if (stop.stop_requested()) return Error{ErrorCode::cancelled, "cancelled", {}, {}};
  auto place = places.begin();
  for (TagList& list : labels.tags)
    for (const TaggedObject& tagged : list.objects) {
      if (*place)
        write_tag(tagged.text, list.spec->height_mm, **place, sheet.views[list.view].tags);
      else if (list.count.crowded++ == 0)
        list.count.first_crowded = tagged.text;
      ++place;
    }
  for (BalloonList& list : labels.balloons)
    for (const Balloon& balloon : list.all) {
      if (*place)
        write_balloon(list, balloon.number, **place, sheet.views[balloon.view].tags);
      else
        list.crowded.push_back(balloon.number);
      ++place;
    }
  return {};
}

}  // namespace strake::sheets
