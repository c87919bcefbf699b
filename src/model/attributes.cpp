// SPDX-License-Identifier: Apache-2.0
#include "model/attributes.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/text_encoding.hpp"
#include "core/units.hpp"

namespace strake::model {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

bool is_quote(char c) { return c == '\'' || c == '"'; }

/// Whether a text without blanks round it is quoted.
bool is_quoted(std::string_view text) {
  return text.size() >= 2 && is_quote(text.front()) && text.back() == text.front();
}

std::string_view without_quotes(std::string_view text) {
  return trimmed(text.substr(1, text.size() - 2), kBlanks);
}

/// Returns the beginning of a list, up to the first separator. A quote there holds up to the next
/// such quote that ends a piece; one that nothing closes is part of a name.
std::string_view first_piece(std::string_view list, std::string_view separator) {
  const std::string_view plain = list.substr(0, list.find(separator));
  const std::size_t open = plain.find_first_not_of(kBlanks);
  if (open == std::string_view::npos || !is_quote(list[open])) return plain;
  for (std::size_t close = open + 1; close < list.size(); ++close) {
    if (list[close] != list[open]) continue;
    const std::string_view behind = list.substr(close + 1);
    const std::size_t end = std::min(behind.find(separator), behind.size());
    if (trimmed(behind.substr(0, end), kBlanks).empty()) return list.substr(0, close + 1 + end);
  }
  return plain;
}

template <class Take>
void each_listed(std::string_view list, std::string_view separator, Take&& take) {
  const auto is_one = [&] { return first_piece(list, separator).size() == list.size(); };
  list = trimmed(list, kBlanks);
  while (is_quoted(list) && is_one()) list = without_quotes(list);  // round the whole list
  for (;;) {
    const std::string_view piece = first_piece(list, separator);
    take(piece);
    if (piece.size() == list.size()) return;
    list.remove_prefix(piece.size() + separator.size());
  }
}

}  // namespace

std::string_view unquoted(std::string_view text) {
  text = trimmed(text, kBlanks);
  while (is_quoted(text)) text = without_quotes(text);
  return text;
}

bool is_null_value(std::string_view value) {
  constexpr std::array<std::string_view, 5> kNone{"", "nulref", "unset", "none", "=0/0"};
  const auto same = [&](std::string_view word) {
    return std::equal(value.begin(), value.end(), word.begin(), word.end(), [](char a, char b) {
      return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
    });
  };
  return std::any_of(kNone.begin(), kNone.end(), same);
}

std::vector<std::string_view> values_of(const Attributes& attributes, std::string_view attribute) {
  return listed_values_of(attributes, attribute, {});
}

std::vector<std::string_view> values_of(const Model& model, const Object& object,
                                        std::string_view attribute) {
  const Attributes* const stated = model.stated(object, attribute).attributes;
  return stated == nullptr ? std::vector<std::string_view>() : values_of(*stated, attribute);
}

std::vector<std::string_view> listed_values_of(const Attributes& attributes,
                                               std::string_view attribute,
                                               std::string_view separator) {
  std::vector<std::string_view> values;
  const auto take = [&](std::string_view text) {
    const std::string_view value = unquoted(text);
    if (!is_null_value(value)) values.push_back(value);
  };
  for (const auto& [name, value] : attributes) {
    if (name != attribute) continue;
    if (separator.empty())
      take(value);
    else
      each_listed(value, separator, take);
  }
  return values;
}

std::optional<double> unit_of_value_mm(std::string_view unit) {
  if (unit.empty()) return 1.0;
  if (const auto mm = unit_mm(unit)) return mm;
  return unit_mm(lowered(unit.substr(0, unit.find_first_of(" \t"))));
}

std::optional<double> length_of_value_mm(std::string_view value) {
  const auto quantity = parse_quantity(value);
  if (!quantity) return std::nullopt;
  const auto unit = unit_of_value_mm(quantity->unit);
  return unit ? std::optional(quantity->number * *unit) : std::nullopt;
}

std::string_view name(Category category) {
  switch (category) {
    case Category::physical:
      return "physical";
    case Category::obstruction:
      return "obstruction";
    case Category::insulation:
      return "insulation";
  }
  return {};
}

std::string color_text(const Color& c) {
  return c.alpha == 255 ? fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue)
                        : fmt::format("#{:02x}{:02x}{:02x}{:02x}", c.red, c.green, c.blue, c.alpha);
}

SelectableProperties selectable_properties(const Model& model, ObjectId id) {
  const Object& object = model.object(id);
  SelectableProperties of;
  std::vector<std::string_view> names = model.group_names(object);
  names.emplace_back(object.name);
  of.path = joined_path(names);
  for (std::uint32_t b = 0; b < object.body_count; ++b) {
    const Body& body = model.bodies[object.first_body + b];
    of.types.emplace(kind_name(model.shapes[index(body.shape)]));
    of.categories.emplace(name(body.category));
    of.colors.insert(color_text(body.color));
  }
  of.attributes = object.attributes;
  // A value stated nearer hides what groups farther out state under the same name.
  GroupId at = object.parent;
  for (std::size_t steps = 0; index(at) < model.groups.size() && steps < model.groups.size();
       ++steps) {
    const Group& group = model.groups[index(at)];
    if (group.attributes < model.group_attributes.size())
      for (const auto& [attribute, value] : model.group_attributes[group.attributes])
        if (const Model::Stated stated = model.stated(object, attribute);
            stated.attributes == &model.group_attributes[group.attributes])
          of.attributes.emplace_back(attribute, value);
    at = group.parent;
  }
  return of;
}

}  // namespace strake::model
