// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "clash/narrow_phase/acceleration_cache.hpp"
#include "clash/results/object_results.hpp"

namespace strake::clash {

/// Computes Pair::volume_mm3 of every HIT of the report: the common volumes of its pairs of solid
/// parts whose interiors meet, added up in their order.
[[nodiscard]] Status measure_volumes(const PartResults& results, AccelerationCache& cache,
                                     const parallel::Context& context, Report& report);

}  // namespace strake::clash
