// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "hlr/seen_shapes.hpp"
#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// The hatch of each object, both numbers chosen where they were not given: the spacing tells
/// colours apart and the angle neighbours, as far as the few usual angles go. Objects are
/// neighbours where outlines of their sections meet within `contact` (by body). `usual_mm`: the
/// usual spacing. Objects that are not cut keep what was given. Errors: cancelled.
[[nodiscard]] Result<std::vector<Hatch>> choose_hatches(
    const model::Scene& scene, const SeenShapes& seen, const std::vector<std::int64_t>& contact,
    const std::vector<Hatch>& given, double usual_mm, const parallel::Context& context);

}  // namespace strake::hlr
