// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "model/ends/end_joints.hpp"

namespace strake::rules {

/// What rules ask of the geometry of objects, of each by itself.
struct ObjectFacts {
  std::vector<std::vector<bool>> picked;  ///< by selection of the rules, an entry per object
  /// The ends of all objects, by object; absent where no rule is about ends.
  std::optional<std::vector<model::ObjectEnd>> ends;
  bool obstructions = false, insulation = false;  ///< whether a body is of that category
  std::size_t objects = 0;

  /// Appends the facts of objects that come behind.
  void append(const ObjectFacts& more);
};

/// Sets whether bodies of a model are of these categories.
void detect_categories(const model::Model& model, ObjectFacts& facts);

}  // namespace strake::rules
