// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cli/run/session.hpp"
#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/model/selection.hpp"

namespace strake::cli {

/// Parses the selections of an option that may be given several times; an error names the option.
[[nodiscard]] Result<std::vector<model::Selection>> parse_selections(
    const std::vector<std::string>& texts, const std::string& option);

/// A selection that picks nothing, in words, and how to find what there is to be picked.
struct IdleSelection {
  std::string message, mend;
};

/// What several selections pick together.
struct SelectedObjects {
  std::vector<bool> any;  ///< an entry per object: whether one of them picks it
  std::vector<IdleSelection> idle;
};

[[nodiscard]] Result<SelectedObjects> pick_all(Session& session, const model::Scene& scene,
                                               const std::vector<model::Selection>& selections);

/// Returns which objects one of the selections picks, an entry per object; empty where there are no
/// selections. A selection that picks nothing is an error: it is misspelt more often than meant.
[[nodiscard]] Result<std::vector<bool>> pick_any(Session& session, const model::Scene& scene,
                                                 const std::vector<model::Selection>& selections,
                                                 const std::string& option);

}  // namespace strake::cli
