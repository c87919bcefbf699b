// SPDX-License-Identifier: Apache-2.0
#include "sheets/annotation/tags.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "drawing/layout/view_plane.hpp"
#include "model/attributes.hpp"
#include "sheets/spec/template.hpp"
#include "sheets/spec/text_metrics.hpp"

namespace strake::sheets {

namespace {

using drawing::Line;
using drawing::rounded_paper;

constexpr std::array<std::string_view, 5> kNames{"name", "id", "path", "file", "type"};

/// The distance between two texts, and between a text and its line.
constexpr double kClearance = 0.7;

/// The directions of leaders: unit vectors, the upper right first.
constexpr std::array<PaperPoint, 12> kDirections{{{0.6, -0.8},
                                                  {-0.6, -0.8},
                                                  {0.8, -0.6},
                                                  {-0.8, -0.6},
                                                  {0.6, 0.8},
                                                  {-0.6, 0.8},
                                                  {0.8, 0.6},
                                                  {-0.8, 0.6},
                                                  {0.28, -0.96},
                                                  {-0.28, -0.96},
                                                  {0.28, 0.96},
                                                  {-0.28, 0.96}}};
constexpr std::array<double, 9> kLengths{6, 9, 13, 18, 24, 32, 42, 55, 70};

/// Returns the value of an object for a name in a text; empty where it has none.
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

/// An object as a view shows it.
struct TaggedObject {
  model::ObjectId object{};
  PaperPoint anchor;  ///< the middle of its longest visible line
  PaperBox box;       ///< box of its visible lines
  double length = 0;  ///< length of all of them
  std::string text;
};

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
      seen.anchor = {rounded_paper((line.a_paper.x + line.b_paper.x) / 2),
                     rounded_paper((line.a_paper.y + line.b_paper.y) / 2)};
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

class Writer {
 public:
  Writer(const TagSpec& spec, const SheetArea& room, PlacedView& view, OccupancyGrid& occupancy)
      : spec_(spec), room_(room), view_(view), occupancy_(occupancy) {}

  bool write(const TaggedObject& seen) { return spec_.leader ? with_leader(seen) : plain(seen); }

 private:
  [[nodiscard]] bool takes(const PaperBox& box) const {
    const PaperBox wide{box.left - kClearance, box.top - kClearance, box.right + kClearance,
                        box.bottom + kClearance};
    return room_.takes(wide) && occupancy_.is_open(wide);
  }

  void put(const Text& text) {
    occupancy_.block(box_of(text));
    view_.tags.texts.push_back(text);
  }

  bool plain(const TaggedObject& seen) {
    const double h = spec_.height_mm;
    const PaperPoint middle{rounded_paper((seen.box.left + seen.box.right) / 2),
                            rounded_paper((seen.box.top + seen.box.bottom) / 2 + h / 2)};
    for (const double lines : {0.0, -1.0, 1.0, -2.0, 2.0}) {
      const Text text{LineClass::leader,
                      {middle.x, rounded_paper(middle.y + lines * 1.6 * h)},
                      h,
                      Align::middle,
                      seen.text,
                      true};
      if (!takes(box_of(text))) continue;
      put(text);
      return true;
    }
    return false;
  }

  /// A text above a landing, and the line from there to the object.
  struct TagPosition {
    Text text;
    PaperPoint elbow, end;
  };

  [[nodiscard]] TagPosition place(const TaggedObject& seen, const PaperPoint& way,
                                  double length) const {
    const double width = text_width(seen.text) * spec_.height_mm;
    TagPosition p;
    p.elbow = {rounded_paper(seen.anchor.x + way.x * length),
               rounded_paper(seen.anchor.y + way.y * length)};
    const bool right = way.x > 0;
    p.end = {rounded_paper(p.elbow.x + (right ? width : -width)), p.elbow.y};
    p.text = {LineClass::leader, {p.elbow.x, rounded_paper(p.elbow.y - kClearance)},
              spec_.height_mm,   right ? Align::start : Align::end,
              seen.text,         true};
    return p;
  }

  bool with_leader(const TaggedObject& seen) {
    std::optional<TagPosition> best;
    double least = 0;
    for (const double length : kLengths) {
      if (best && length >= least) break;  // no place farther away can be better
      for (const PaperPoint& way : kDirections) {
        const TagPosition p = place(seen, way, length);
        PaperBox box = box_of(p.text);
        box.bottom = std::max(box.bottom, p.elbow.y);
        if (!takes(box)) continue;
        const OccupancyGrid::LeaderPath line = occupancy_.way(seen.anchor, p.elbow);
        if (!line.open) continue;
        const double cost =
            length + 4 * occupancy_.ink(box) + 12 * static_cast<double>(line.crossed);
        if (best && cost >= least) continue;
        least = cost;
        best = p;
      }
    }
    if (!best) return false;
    put(best->text);
    occupancy_.add_leader(seen.anchor, best->elbow);
    occupancy_.add_leader(best->elbow, best->end);
    view_.tags.paths.push_back({LineClass::leader, {seen.anchor, best->elbow, best->end}, false});
    view_.tags.paths.push_back(arrow(seen.anchor, best->elbow));
    return true;
  }

  /// Returns the arrow head at the object: as long as the letters are high, a third as wide.
  [[nodiscard]] Path arrow(const PaperPoint& tip, const PaperPoint& from) const {
    const double dx = from.x - tip.x, dy = from.y - tip.y;
    const double length = std::sqrt(dx * dx + dy * dy);
    const double x = dx / length * spec_.height_mm, y = dy / length * spec_.height_mm;
    const PaperPoint left{rounded_paper(tip.x + x - y / 6), rounded_paper(tip.y + y + x / 6)};
    const PaperPoint right{rounded_paper(tip.x + x + y / 6), rounded_paper(tip.y + y - x / 6)};
    return {LineClass::leader, {tip, left, right, tip}, true};
  }

  const TagSpec& spec_;
  const SheetArea& room_;
  PlacedView& view_;
  OccupancyGrid& occupancy_;
};

}  // namespace

bool is_tag_name(std::string_view name) {
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end() ||
         (name.size() > 1 && name.front() == '@');
}

TagCount write_tags(const TagSpec& spec, const std::vector<bool>& picked, const model::Model& model,
                    const SheetArea& room, PlacedView& view, OccupancyGrid& occupancy) {
  TagCount count;
  const auto pieces = split_placeholders(spec.text);
  if (!pieces) return count;
  std::vector<TaggedObject> all = seen_objects(view.ink, picked);
  count.unseen =
      static_cast<std::size_t>(std::count(picked.begin(), picked.end(), true)) - all.size();
  std::vector<TaggedObject> texts;
  for (TaggedObject& seen : all) {
    std::size_t named = 0, lacking = 0;
    seen.text = on_one_line(fill_placeholders(*pieces, [&](const std::string& name) {
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
  if (spec.once) texts = each_text_once(texts);
  Writer writer(spec, room, view, occupancy);
  for (const TaggedObject& seen : texts) ++(writer.write(seen) ? count.written : count.crowded);
  return count;
}

}  // namespace strake::sheets
