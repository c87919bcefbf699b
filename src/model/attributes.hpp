// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "strake/model/model.hpp"

namespace strake::model {

// These functions read what attributes say. Blanks and quotes round a value do not count, and "",
// "Nulref", "unset", "none" and "=0/0" say that there is none. All views are into the argument.

/// Returns a value without the blanks and quotes round it.
[[nodiscard]] std::string_view unquoted(std::string_view text);

/// Whether a bare value says that there is none.
[[nodiscard]] bool is_null_value(std::string_view value);

/// Returns the values of the attributes of this name, bare, without those that say that there is
/// none.
[[nodiscard]] std::vector<std::string_view> values_of(const Attributes& attributes,
                                                      std::string_view attribute);
/// Returns the values of an object's attributes, inherited ones too.
[[nodiscard]] std::vector<std::string_view> values_of(const Model& model, const Object& object,
                                                      std::string_view attribute);

/// Returns the values of attributes that hold lists: what lies between separators counts as a value
/// of its own, with quotes of its own, within which separators do not split. Quotes may also
/// enclose a whole list. With an empty separator each value is one.
[[nodiscard]] std::vector<std::string_view> listed_values_of(const Attributes& attributes,
                                                             std::string_view attribute,
                                                             std::string_view separator);

/// Returns the length of a unit as values have it, mm: in capitals too, and with more behind it
/// ("MM x 20MM" of "150MM x 20MM"). A value without a unit is in millimetres. Nothing where it is
/// no unit of length.
[[nodiscard]] std::optional<double> unit_of_value_mm(std::string_view unit);
/// Returns the length that a bare value begins with, mm; nothing where it begins with none.
[[nodiscard]] std::optional<double> length_of_value_mm(std::string_view value);

/// The properties of one object that selections test, in the words in which they are compared
/// (docs/selection.md).
struct SelectableProperties {
  std::string path;  ///< its groups and its own name
  /// The types, categories and colours of its bodies, each once.
  std::set<std::string> types, categories, colors;
  /// Its own attributes, then those that it inherits, of the nearest group first.
  Attributes attributes;
};

[[nodiscard]] SelectableProperties selectable_properties(const Model& model, ObjectId id);

/// Returns "physical", "obstruction" or "insulation".
[[nodiscard]] std::string_view name(Category category);
/// Returns "#rrggbb", or "#rrggbbaa" when transparent.
[[nodiscard]] std::string color_text(const Color& color);

}  // namespace strake::model
