// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// What became of every object of a scene: `drawn` by object; pieces and what was left out, of a
/// drawing that has its lines. Errors: cancelled.
[[nodiscard]] Result<Account> account_of(const model::Scene& scene, const std::vector<bool>& drawn,
                                         const Drawing& drawing, const parallel::Context& context);

/// A warning for each object that is degenerate, failed, or drawn without some of its geometry; not
/// for wires that are seen end-on.
void report_defects(const model::Model& model, const Account& account, Diagnostics& diagnostics);

}  // namespace strake::hlr
