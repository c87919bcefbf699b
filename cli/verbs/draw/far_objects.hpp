// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cli/run/session.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"

namespace strake::cli {

/// Looks for objects that lie so far from all others that they decide the scale of a view. It takes
/// them out of `drawn` and names them in `layout` where they are to be left out, and warns of them
/// otherwise. Errors: cancelled.
[[nodiscard]] Status resolve_far_objects(Session& session, const model::Scene& scene,
                                      const hlr::View& view, bool leave_out,
                                      std::vector<bool>& drawn, drawing::LayoutOptions& layout);

}  // namespace strake::cli
