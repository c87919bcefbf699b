// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "clash/part_aids.hpp"
#include "clash/reduce.hpp"

namespace strake::clash {

/// Pair::volume_mm3 of every HIT of the report: the common volumes of its pairs of solid parts
/// whose interiors meet, added up in their order.
[[nodiscard]] Status measure_volumes(const PartFindings& findings, PartAids& aids,
                                     const parallel::Context& context, Report& report);

}  // namespace strake::clash
