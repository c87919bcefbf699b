// SPDX-License-Identifier: Apache-2.0
#include "model/hierarchy.hpp"

#include <algorithm>
#include <cstdint>

namespace strake::model {

Hierarchy::Hierarchy(const Model& model) : model_(model) {
  for (std::uint32_t g = 0; g < model.groups.size(); ++g) {
    const auto key = std::pair(model.groups[g].parent, std::string_view(model.groups[g].name));
    const auto [at, added] = own_.try_emplace(key, GroupId{g});
    if (!added) at->second = GroupId::none;  // two have one name: it is not known which is meant
  }
}

std::vector<GroupId> Hierarchy::path(const Object& object) const {
  std::vector<GroupId> path;
  for (GroupId g = object.parent; known(g) && path.size() <= model_.groups.size();
       g = model_.groups[index(g)].parent)
    path.push_back(g);
  std::reverse(path.begin(), path.end());
  const auto own = own_.find({object.parent, std::string_view(object.name)});
  if (own != own_.end() && own->second != GroupId::none) path.push_back(own->second);
  return path;
}

const Attributes* Hierarchy::attributes(GroupId group) const {
  const std::uint32_t own = model_.groups[index(group)].attributes;
  return own < model_.group_attributes.size() ? &model_.group_attributes[own] : nullptr;
}

}  // namespace strake::model
