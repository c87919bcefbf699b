// SPDX-License-Identifier: Apache-2.0
#include "sheets/labels/tags.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>

#include "model/attributes.hpp"
#include "sheets/spec/template.hpp"
#include "sheets/spec/text_metrics.hpp"

namespace strake::sheets {

namespace {

constexpr std::array<std::string_view, 5> kNames{"name", "id", "path", "file", "type"};

/// Returns of objects with equal texts the one that shows most, in the order of the model.
std::vector<TaggedObject> each_text_once(const std::vector<TaggedObject>& all) {
  std::map<std::string_view, const TaggedObject*> largest;
  for (const TaggedObject& tagged : all) {
    const TaggedObject*& best = largest[tagged.text];
    if (best == nullptr || tagged.visible.length > best->visible.length) best = &tagged;
  }
  std::vector<TaggedObject> once;
  for (const TaggedObject& tagged : all)
    if (largest[tagged.text] == &tagged) once.push_back(tagged);
  return once;
}

/// Writes the texts of the objects that have all or some of the values that a tag names; counts the
/// others.
std::vector<TaggedObject> with_texts(const std::vector<VisibleObject>& all,
                                     const std::vector<TextPiece>& pieces,
                                     const model::Model& model, TagCount& count) {
  std::vector<TaggedObject> texts;
  for (const VisibleObject& visible : all) {
    std::size_t named = 0, lacking = 0;
    std::string text = on_one_line(fill_placeholders(pieces, [&](const std::string& name) {
      std::string value = value_of_name(model, visible.object, name);
      ++named;
      if (value.empty()) ++lacking;
      return value;
    }));
    if (named > 0 && lacking == named) {
      ++count.blank;
      continue;
    }
    if (lacking > 0) ++count.partly;
    texts.push_back({visible, std::move(text), false});
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
  const std::vector<VisibleObject> all = visible_objects(sheet.views[view].ink, picked);
  list.count.unseen =
      static_cast<std::size_t>(std::count(picked.begin(), picked.end(), true)) - all.size();
  list.objects = with_texts(all, *pieces, model, list.count);
  if (spec.once) list.objects = each_text_once(list.objects);
  return list;
}

}  // namespace strake::sheets
