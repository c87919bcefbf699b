// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "clash/results/object_results.hpp"

namespace strake::clash {

/// Fills Pair::regions and Report::regions from the regions of the parts: those as open or as
/// allowed as the pair itself; for a clearance violation all that are one, otherwise all within the
/// touch gap. What rules allow of an open pair is counted apart: Pair::allowed_regions,
/// AllowedCount::regions, Report::count_allowed_regions, also where EngineOptions::max_regions is
/// 0. Regions of different pairs of parts are one where their boxes meet, as parts of an object
/// hang together there. `pairs` of the report still carry the number of their first result in
/// Pair::first_region, as aggregate_by_object() leaves them. Errors: cancelled.
[[nodiscard]] Status aggregate_regions(const PartResults& results, const parallel::Context& context,
                                       Report& report);

}  // namespace strake::clash
