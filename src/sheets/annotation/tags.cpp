// SPDX-License-Identifier: Apache-2.0
#include "sheets/annotation/tags.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "drawing/layout/view_plane.hpp"
#include "model/attributes.hpp"
#include "sheets/annotation/label_placement.hpp"
#include "sheets/spec/template.hpp"
#include "sheets/spec/text_metrics.hpp"

namespace strake::sheets {

namespace {

using drawing::Line;
using drawing::rounded_paper;

constexpr std::array<std::string_view, 5> kNames{"name", "id", "path", "file", "type"};

double length_of(const Line& line) {
  const double dx = line.b_paper.x - line.a_paper.x, dy = line.b_paper.y - line.a_paper.y;
  return std::sqrt(dx * dx + dy * dy);
}

/// Returns the picked objects that have visible lines, in the order of the model.
std::vector<TaggedObject> seen_objects(const drawing::Ink& ink, const std::vector<bool>& picked) {
  std::vector<TaggedObject> all;
  double longest = 0;
  for (const Line& line : ink.lines) {
    if (line.state != drawing::LineState::visible || !picked[model::index(line.object)]) continue;
    const double length = length_of(line);
    if (!(length > 0)) continue;
    if (all.empty() || all.back().object != line.object) {
      all.push_back({line.object,
                     {},
                     {line.a_paper.x, line.a_paper.y, line.a_paper.x, line.a_paper.y},
                     0,
                     {}});
      longest = 0;
    }
    TaggedObject& seen = all.back();
    seen.length += length;
    if (length > longest) {
      longest = length;
      seen.longest = {line.a_paper, line.b_paper};
    }
    for (const PaperPoint& p : {line.a_paper, line.b_paper}) {
      seen.box.left = std::min(seen.box.left, p.x);
      seen.box.right = std::max(seen.box.right, p.x);
      seen.box.top = std::min(seen.box.top, p.y);
      seen.box.bottom = std::max(seen.box.bottom, p.y);
    }
  }
  return all;
}

/// Returns of objects with equal texts the one that shows most, in the order of the model.
std::vector<TaggedObject> each_text_once(const std::vector<TaggedObject>& all) {
  std::map<std::string_view, const TaggedObject*> most;
  for (const TaggedObject& seen : all) {
    const TaggedObject*& best = most[seen.text];
    if (best == nullptr || seen.length > best->length) best = &seen;
  }
  std::vector<TaggedObject> once;
  for (const TaggedObject& seen : all)
    if (most[seen.text] == &seen) once.push_back(seen);
  return once;
}

/// Returns where leaders to an object may end: the middle of its longest visible line and, on long
/// ones, the quarters.
std::vector<PaperPoint> anchors_of(const PaperSegment& longest) {
  constexpr double kLongMm = 12;
  const double dx = longest.b.x - longest.a.x, dy = longest.b.y - longest.a.y;
  const auto at = [&](double t) {
    return PaperPoint{rounded_paper(longest.a.x + dx * t), rounded_paper(longest.a.y + dy * t)};
  };
  if (dx * dx + dy * dy < kLongMm * kLongMm) return {at(0.5)};
  return {at(0.5), at(0.25), at(0.75)};
}

LabelRequest request_of(const TagList& list, const TaggedObject& seen) {
  return {.width_mm = text_width(seen.text) * list.spec->height_mm,
          .height_mm = list.spec->height_mm,
          .anchors = anchors_of(seen.longest),
          .object = seen.box,
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

/// Writes the texts of the objects that have all or some of the values that a tag names; counts the
/// others.
std::vector<TaggedObject> with_texts(std::vector<TaggedObject> all,
                                     const std::vector<TextPiece>& pieces,
                                     const model::Model& model, TagCount& count) {
  std::vector<TaggedObject> texts;
  for (TaggedObject& seen : all) {
    std::size_t named = 0, lacking = 0;
    seen.text = on_one_line(fill_placeholders(pieces, [&](const std::string& name) {
      std::string value = value_of_name(model, seen.object, name);
      ++named;
      if (value.empty()) ++lacking;
      return value;
    }));
    if (named > 0 && lacking == named) {
      ++count.blank;
      continue;
    }
    if (lacking > 0) ++count.partly;
    texts.push_back(std::move(seen));
  }
  return texts;
}

}  // namespace

bool is_tag_name(std::string_view name) {
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end() ||
         (name.size() > 1 && name.front() == '@');
}

std::string value_of_name(const model::Model& model, model::ObjectId id, const std::string& name) {
  const model::Object& object = model.object(id);
  if (name == "name") return object.name;
  if (name == "id") return object.id;
  if (name == "file") return model.files[object.file].label;
  if (name == "path" || name == "type") {
    const model::SelectableProperties all = model::selectable_properties(model, id);
    if (name == "path") return all.path;
    return all.types.empty() ? std::string() : *all.types.begin();
  }
  const auto values = model::values_of(model, object, std::string_view(name).substr(1));
  return values.empty() ? std::string() : std::string(values.front());
}

TagList tags_of(const TagSpec& spec, const std::vector<bool>& picked, const model::Model& model,
                const Sheet& sheet, std::size_t view) {
  TagList list{&spec, view, {}, {}};
  const auto pieces = split_placeholders(spec.text);
  if (!pieces) return list;
  std::vector<TaggedObject> all = seen_objects(sheet.views[view].ink, picked);
  list.count.unseen =
      static_cast<std::size_t>(std::count(picked.begin(), picked.end(), true)) - all.size();
  list.objects = with_texts(std::move(all), *pieces, model, list.count);
  if (spec.once) list.objects = each_text_once(list.objects);
  return list;
}

Status write_tags(std::span<TagList> lists, const SheetArea& room, Sheet& sheet,
                  const std::stop_token& stop) {
  std::vector<LabelRequest> requests;
  for (const TagList& list : lists)
    for (const TaggedObject& seen : list.objects) requests.push_back(request_of(list, seen));
  const OccupancyGrid occupied = occupied_paper(sheet);
  LabelGround ground{sheet.width_mm, sheet.height_mm, occupied, room, {}};
  for (const PlacedView& view : sheet.views) ground.views.push_back(view.box);
  const auto places = place_labels(requests, ground, stop);
  if (stop.stop_requested()) return Error{ErrorCode::cancelled, "cancelled", {}, {}};
  auto place = places.begin();
  for (TagList& list : lists)
    for (const TaggedObject& seen : list.objects) {
      if (*place)
        write_tag(seen.text, list.spec->height_mm, **place, sheet.views[list.view].tags);
      else if (list.count.crowded++ == 0)
        list.count.first_crowded = seen.text;
      ++place;
    }
  return {};
}

}  // namespace strake::sheets
