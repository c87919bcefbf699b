// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "clash/narrow_phase/acceleration_cache.hpp"
#include "clash/results/object_results.hpp"
#include "geometry/intersection_volume/intersection_volume.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::clash {

/// Cubic grid units in a cubic millimetre.
inline constexpr double kCubicGridPerMm =
    geometry::kGridPerMm * geometry::kGridPerMm * geometry::kGridPerMm;

/// Two solid parts whose interiors meet.
struct SolidOverlap {
  const ScenePart* a = nullptr;
  const ScenePart* b = nullptr;
  std::size_t pair = 0;  ///< the pair of objects, as the caller numbers them
};

/// Measures the common volume of each, in cubic grid units; nothing where it takes too long. Counts
/// what that cost. Errors: cancelled.
[[nodiscard]] Result<std::vector<std::optional<geometry::IntersectionVolume>>> measure_overlaps(
    const std::vector<SolidOverlap>& overlaps, const ScenePartList& list, AccelerationCache& cache,
    const parallel::Context& context, Counters& counters);

/// Computes Pair::volume_mm3 of every HIT of the report: the common volumes of its pairs of solid
/// parts whose interiors meet, added up in their order.
[[nodiscard]] Status measure_volumes(const PartResults& results, AccelerationCache& cache,
                                     const parallel::Context& context, Report& report);

}  // namespace strake::clash
