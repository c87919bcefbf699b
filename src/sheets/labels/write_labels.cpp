// SPDX-License-Identifier: Apache-2.0
#include "sheets/labels/write_labels.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "drawing/layout/view_plane.hpp"
#include "sheets/labels/along_tags.hpp"
#include "sheets/labels/label_placement.hpp"
#include "sheets/labels/paper/occupancy_grid.hpp"
#include "sheets/labels/paper/sheet_lines.hpp"
#include "sheets/spec/text_metrics.hpp"

namespace strake::sheets {

namespace {

using drawing::rounded_paper;

/// How long the arrow of a balloon is.
constexpr double kBalloonArrowMm = 2.5;

LabelRequest request_of(const TagList& list, const TaggedObject& tagged) {
  return {.width_mm = text_width(tagged.text) * list.spec->height_mm,
          .height_mm = list.spec->height_mm,
          .anchors = anchors_of(tagged.visible.longest),
          .object = tagged.visible.box,
          .on_object = list.spec->style == TagSpec::Style::plain,
          .view = list.view};
}

/// Takes the paper of views, their captions, frames and grid lines.
void occupy(const Sheet& sheet, OccupancyGrid& occupied) {
  each_line(sheet, [&](const PaperPoint& a, const PaperPoint& b) { occupied.add_line(a, b); });
  for (const PlacedView& view : sheet.views)
    for (const Marks* marks : marks_beside_lines(view)) {
      for (const Text& text : marks->texts)
        for (const PaperBox& box : boxes_of(text)) occupied.block(box);
      for (const Circle& c : marks->circles)
        occupied.block({c.center.x - c.radius_mm, c.center.y - c.radius_mm,
                        c.center.x + c.radius_mm, c.center.y + c.radius_mm});
    }
}

/// Writes the tags that find a place along their objects, and counts those that get a leader.
Status write_along(std::span<TagList> lists, const model::Model& model, const SheetArea& room,
                   OccupancyGrid& occupied, Sheet& sheet, const std::stop_token& stop) {
  const auto lies_along = [](const TagList& list) {
    return list.spec->style == TagSpec::Style::along && !list.objects.empty();
  };
  if (std::ranges::none_of(lists, lies_along)) return {};
  AlongTags placer(sheet, model, room, occupied);
  for (TagList& list : lists) {
    if (!lies_along(list)) continue;
    PlacedView& view = sheet.views[list.view];
    for (TaggedObject& tagged : list.objects) {
      if (stop.stop_requested()) return Error{ErrorCode::cancelled, "cancelled", {}, {}};
      auto text = placer.place(view, tagged.visible.object, tagged.text, list.spec->height_mm);
      tagged.placed = text.has_value();
      if (text)
        view.tags.texts.push_back(std::move(*text));
      else if (list.count.too_short++ == 0)
        list.count.first_too_short = tagged.text;
    }
  }
  return {};
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
                       .anchors = anchors_of(balloon.visible.longest),
                       .object = balloon.visible.box,
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

Status write_labels(SheetLabels& labels, const model::Model& model, const SheetArea& room,
                    Sheet& sheet, const std::stop_token& stop) {
  OccupancyGrid occupied(sheet.width_mm, sheet.height_mm);
  occupy(sheet, occupied);
  if (const Status status = write_along(labels.tags, model, room, occupied, sheet, stop); !status)
    return status;
  occupied.finish();
  std::vector<LabelRequest> requests;
  for (const TagList& list : labels.tags)
    for (const TaggedObject& tagged : list.objects)
      if (!tagged.placed) requests.push_back(request_of(list, tagged));
  for (const BalloonList& list : labels.balloons)
    for (const Balloon& balloon : list.all) requests.push_back(request_of(list, balloon, sheet));
  LabelGround ground{sheet.width_mm, sheet.height_mm, occupied, room, {}};
  for (const PlacedView& view : sheet.views) ground.views.push_back(view.box);
  const auto places = place_labels(requests, ground, stop);
  if (stop.stop_requested()) return Error{ErrorCode::cancelled, "cancelled", {}, {}};
  auto place = places.begin();
  for (TagList& list : labels.tags)
    for (const TaggedObject& tagged : list.objects) {
      if (tagged.placed) continue;
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
