// SPDX-License-Identifier: Apache-2.0
// The texts of tags: which objects of a view have one, and what it says.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "sheets/labels/visible_objects.hpp"
#include "sheets/spec/sheet_spec.hpp"
#include "strake/model/model.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// Returns whether texts of tags may use a name: name, id, path, file, type or @ATTRIBUTE.
[[nodiscard]] bool is_tag_name(std::string_view name);

/// Returns the value of an object for such a name; empty where it has none.
[[nodiscard]] std::string value_of_name(const model::Model& model, model::ObjectId id,
                                        const std::string& name);

/// What became of the tags of one table in one view.
struct TagCount {
  std::size_t unseen = 0;       ///< objects without a visible line
  std::size_t blank = 0;        ///< objects that lack every value that the text names
  std::size_t partly = 0;       ///< objects that lack some of the values
  std::size_t crowded = 0;      ///< tags that found no room
  std::string first_crowded;    ///< the text of the first of them
  std::size_t too_short = 0;    ///< objects with a leader, along which their tags had no place
  std::string first_too_short;  ///< the text of the first of them
};

/// An object that gets a tag.
struct TaggedObject {
  VisibleObject visible;
  std::string text;
  bool placed = false;  ///< it stands along the object already
};

/// The tags of one table in one view.
struct TagList {
  const TagSpec* spec = nullptr;
  std::size_t view = 0;  ///< index into Sheet::views
  std::vector<TaggedObject> objects;
  TagCount count;
};

/// Returns the tags of the picked objects that a view shows, in the order of the model, so that the
/// places of tags do not depend on the team.
[[nodiscard]] TagList tags_of(const TagSpec& spec, const std::vector<bool>& picked,
                              const model::Model& model, const Sheet& sheet, std::size_t view);

}  // namespace strake::sheets
