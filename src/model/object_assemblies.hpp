// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "strake/model/model.hpp"

namespace strake::model {

/// Whether a name is like "BOX 2 of EQUIPMENT /P-101": an element that its database has no name for
/// is called by its type and its number among those of its owner.
[[nodiscard]] bool is_counted_name(std::string_view name);

/// What each object is a part of: its equipment, structure or branch where the model tells (see
/// Assemblies), else the nearest group with a name of its own. That is the object itself where it
/// has other objects below it, else a group above it; a name that only counts (see
/// is_counted_name()) is none.
class ObjectAssemblies {
 public:
  /// The model has to last as long.
  explicit ObjectAssemblies(const Model& model);

  /// Returns GroupId::none for an object below no such group.
  [[nodiscard]] GroupId of(ObjectId id) const { return of_[index(id)]; }
  /// Returns the names from the outermost group to this one as a path.
  [[nodiscard]] std::string path(GroupId assembly) const;

 private:
  const Model& model_;
  std::vector<GroupId> of_;
};

}  // namespace strake::model
