// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/session.hpp"
#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/model/selection.hpp"

namespace strake::cli {

/// How the sections of some objects are hatched.
struct HatchRule {
  hlr::Hatch hatch;
  std::optional<model::Selection> selection;  ///< none: of all objects
};

/// "30deg,80mm: type = pipe": angle, spacing in the model, or both, or "off", and whose sections.
/// Errors name --hatch.
[[nodiscard]] Result<std::vector<HatchRule>> parse_hatches(const std::vector<std::string>& texts);

/// By object of the scene; the first rule that picks an object counts. Empty without rules.
/// Errors: a selection that picks nothing.
[[nodiscard]] Result<std::vector<hlr::Hatch>> hatches_of(Session& session,
                                                         const model::Scene& scene,
                                                         const std::vector<HatchRule>& rules);

}  // namespace strake::cli
