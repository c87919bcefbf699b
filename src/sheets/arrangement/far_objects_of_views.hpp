// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "sheets/spec/sheet_spec.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::sheets {

/// Minds the objects of each view that lie so far from all others that they decide its scale.
///
/// `drawn` has the objects of each view. Where a view has its limits set to "auto", its far objects
/// are taken out and told of in a note; elsewhere a warning tells of them. Arranged views leave out
/// what is far in any of them, since the view along the far way does not show how far it is.
/// Returns the objects that each view leaves out. Errors: cancelled.
[[nodiscard]] Result<std::vector<std::vector<model::ObjectId>>> resolve_far_objects(
    const SheetSpec& what, const model::Scene& scene, std::span<std::vector<bool>* const> drawn,
    Diagnostics& diagnostics, const parallel::Context& context);

}  // namespace strake::sheets
