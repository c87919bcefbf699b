// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/geometry/part.hpp"
#include "strake/parallel/context.hpp"

namespace strake::geometry {

/// Whether no vertex of a solid stands above the plane of a face by more than `slack` grid units.
/// Two such parts come within a reach of each other that is well above the slack in one region.
/// A false answer promises nothing: a solid that would take long to check is not checked.
[[nodiscard]] bool nearly_convex(const Part& part, double slack,
                                 const parallel::Context& context = {});

}  // namespace strake::geometry
