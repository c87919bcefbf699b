// SPDX-License-Identifier: Apache-2.0
#include "model/object_assemblies.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace strake::model {
namespace {

bool is_group(const Model& model, GroupId id) { return index(id) < model.groups.size(); }

/// Returns the nearest group of a path with a name of its own.
GroupId nearest_named(const Hierarchy& hierarchy, const std::vector<GroupId>& path) {
  const auto named = std::find_if(path.rbegin(), path.rend(), [&](GroupId g) {
    return !hierarchy.name(g).empty() && !is_counted_name(hierarchy.name(g));
  });
  return named == path.rend() ? GroupId::none : *named;
}

}  // namespace

bool is_counted_name(std::string_view name) {
  constexpr std::string_view kDigits = "0123456789";
  const std::size_t number = name.find(' ') + 1;
  if (number < 2) return false;
  const std::size_t end = name.find_first_not_of(kDigits, number);
  return end != std::string_view::npos && end > number && name.substr(end).starts_with(" of ");
}

GroupId ObjectAssemblies::of(ObjectId id) const {
  const std::vector<GroupId> path = hierarchy_.path(model_.object(id));
  const std::size_t depth = types_.depth(path);
  return depth > 0 ? path[depth - 1] : nearest_named(hierarchy_, path);
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
