// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hlr/edges/intersection_lines.hpp"
#include "hlr/prepare/view_job.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// Returns the lines along which the skins of parts that sections leave whole pass through what
/// sections leave of other parts, their cut faces included: a bolt that stands out of a plate
/// without a hole for it. Empty where intersections are not drawn, or nothing is left whole.
/// Errors: those of find_intersection_lines().
[[nodiscard]] Result<std::vector<IntersectionLine>> lines_with_uncut(
    const ViewJob& job, const parallel::Context& context);

}  // namespace strake::hlr
