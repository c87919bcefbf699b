// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "model/assemblies.hpp"
#include "model/hierarchy.hpp"
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
  explicit ObjectAssemblies(const Model& model) : model_(model), hierarchy_(model), types_(model) {}

  /// Returns GroupId::none for an object below no such group. It is found anew for each: results
  /// name few of the objects of a model.
  [[nodiscard]] GroupId of(ObjectId id) const;
  /// Whether the model tells of any group that it is an equipment, a structure or a branch.
  [[nodiscard]] bool typed() const { return !types_.empty(); }
  /// Returns the names from the outermost group to this one as a path.
  [[nodiscard]] std::string path(GroupId assembly) const;

 private:
  const Model& model_;
  Hierarchy hierarchy_;
  Assemblies types_;
};

}  // namespace strake::model
