// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::python {

/// Objects as a caller names them: by selections, of which one at least picks each, or one by one.
/// Both empty: everything.
struct Pick {
  std::vector<std::string> selections;
  std::vector<bool> objects;

  [[nodiscard]] bool is_everything() const { return selections.empty() && objects.empty(); }
};

/// What was picked, an entry per object.
struct Picked {
  std::vector<bool> objects;
  std::string name;               ///< the selections joined, as the program names a set
  std::vector<std::string> idle;  ///< for each selection that picks nothing, why
};

/// Returns what each of the selections picks; nothing where there are none. Errors: usage, for a
/// text that is no selection; cancelled.
[[nodiscard]] Result<std::vector<std::vector<bool>>> picked_by_each(
    const Pick& wanted, const model::Scene& scene, const parallel::Context& context);

/// Returns what is picked, where it is known what each selection picks. Errors: usage, for as many
/// entries as there are no objects.
[[nodiscard]] Result<Picked> pick(const Pick& wanted, const std::vector<std::vector<bool>>& each,
                                  const model::Model& model);

/// Errors: usage, for a text that is no selection, for as many entries as there are no objects;
/// cancelled.
[[nodiscard]] Result<Picked> pick(const Pick& wanted, const model::Scene& scene,
                                  const parallel::Context& context);

/// The same where picking nothing is an error: usage, at `where`. Empty: everything.
[[nodiscard]] Result<std::vector<bool>> pick_some(const Pick& wanted, const model::Scene& scene,
                                                  const std::string& where,
                                                  const parallel::Context& context);

/// The same where it is known what each selection picks.
[[nodiscard]] Result<std::vector<bool>> pick_some(const Pick& wanted,
                                                  const std::vector<std::vector<bool>>& each,
                                                  const model::Model& model,
                                                  const std::string& where);

/// Appends what selections pick of objects that come behind.
void append_picked(const std::vector<std::vector<bool>>& more, std::vector<std::vector<bool>>& all);

}  // namespace strake::python
