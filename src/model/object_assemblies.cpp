// SPDX-License-Identifier: Apache-2.0
#include "model/object_assemblies.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

#include "model/assemblies.hpp"

namespace strake::model {
namespace {

bool is_group(const Model& model, GroupId id) { return index(id) < model.groups.size(); }

/// Returns the groups that objects lie in, directly or not, by their parent and name.
std::map<std::pair<GroupId, std::string_view>, GroupId> holders(const Model& model) {
  std::vector<bool> holds(model.groups.size());
  for (const Object& object : model.objects)
    for (GroupId at = object.parent; is_group(model, at) && !holds[index(at)];
         at = model.groups[index(at)].parent)
      holds[index(at)] = true;
  std::map<std::pair<GroupId, std::string_view>, GroupId> found;
  for (std::uint32_t g = 0; g < model.groups.size(); ++g)
    if (holds[g]) found.try_emplace({model.groups[g].parent, model.groups[g].name}, GroupId{g});
  return found;
}

/// Returns the nearest group with a name of its own, this one or one above it.
GroupId nearest_named(const Model& model, GroupId at) {
  for (std::size_t steps = 0; is_group(model, at) && steps < model.groups.size(); ++steps) {
    const Group& group = model.groups[index(at)];
    if (!group.name.empty() && !is_counted_name(group.name)) return at;
    at = group.parent;
  }
  return GroupId::none;
}

}  // namespace

bool is_counted_name(std::string_view name) {
  constexpr std::string_view kDigits = "0123456789";
  const std::size_t number = name.find(' ') + 1;
  if (number < 2) return false;
  const std::size_t end = name.find_first_not_of(kDigits, number);
  return end != std::string_view::npos && end > number && name.substr(end).starts_with(" of ");
}

ObjectAssemblies::ObjectAssemblies(const Model& model) : model_(model), of_(assemblies_of(model)) {
  const auto groups = holders(model);
  for (std::size_t o = 0; o < of_.size(); ++o) {
    if (of_[o] != GroupId::none) continue;
    const Object& object = model.objects[o];
    const auto itself = groups.find({object.parent, object.name});
    of_[o] = nearest_named(model, itself == groups.end() ? object.parent : itself->second);
  }
}

std::string ObjectAssemblies::path(GroupId assembly) const {
  std::vector<std::string_view> names;
  for (GroupId at = assembly; is_group(model_, at) && names.size() <= model_.groups.size();
       at = model_.groups[index(at)].parent)
    names.emplace_back(model_.groups[index(at)].name);
  std::ranges::reverse(names);
  return joined_path(names);
}

}  // namespace strake::model
