// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "strake/model/model.hpp"

namespace strake::model {

/// The hierarchy of a model, which must outlive this, as paths from the outermost group.
class Hierarchy {
 public:
  explicit Hierarchy(const Model& model);

  /// Returns the object's groups, outermost first; the group that it is itself, if it is one, last.
  [[nodiscard]] std::vector<GroupId> path(const Object& object) const;

  [[nodiscard]] const std::string& name(GroupId group) const {
    return model_.groups[index(group)].name;
  }
  /// Returns what a group states; null if nothing.
  [[nodiscard]] const Attributes* attributes(GroupId group) const;

 private:
  [[nodiscard]] bool known(GroupId g) const {
    return g != GroupId::none && index(g) < model_.groups.size();
  }
  const Model& model_;
  std::map<std::pair<GroupId, std::string_view>, GroupId> own_;
};

}  // namespace strake::model
