// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

#include "strake/model/model.hpp"

namespace strake::model {

/// What selections go by, of one object, in the words in which they are compared
/// (docs/selection.md).
struct Selectable {
  std::string path;  ///< its groups and its own name
  /// Of its bodies, each once.
  std::set<std::string> types, categories, colors;
  /// Its own, then those that it inherits, of the nearest group first.
  Attributes attributes;
};

[[nodiscard]] Selectable selectable(const Model& model, ObjectId id);

/// "physical", "obstruction", "insulation".
[[nodiscard]] std::string_view name(Category category);
/// "#rrggbb", "#rrggbbaa" when transparent.
[[nodiscard]] std::string color_text(const Color& color);

}  // namespace strake::model
