// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "clash/narrow_phase/acceleration_cache.hpp"
#include "clash/pairs/common_volume.hpp"
#include "clash/results/object_results.hpp"

namespace strake::clash {

/// Measures what two objects have in common, where a rule that may allow their results limits it,
/// and for all that may be a HIT where the test reports none with less than some volume: no other
/// volumes are computed. Fills `volumes` and points PartResult::common of `found`, the list behind
/// `results`, at them. Errors: cancelled.
[[nodiscard]] Status measure_limited_volumes(const PartResults& results,
                                             std::vector<PartResult>& found,
                                             std::vector<CommonVolume>& volumes,
                                             AccelerationCache& cache,
                                             const parallel::Context& context, Report& report);

}  // namespace strake::clash
