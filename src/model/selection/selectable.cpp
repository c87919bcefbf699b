// SPDX-License-Identifier: Apache-2.0
#include "strake/model/selectable.hpp"

#include <fmt/core.h>

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace strake::model {

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

Selectable selectable(const Model& model, ObjectId id) {
  const Object& object = model.object(id);
  Selectable of;
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
  // What is stated nearer hides what groups farther out state under the same name.
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
