// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "hlr/lines.hpp"
#include "hlr/section_planes.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// Hatch lines on the caps that look towards the viewer, by body. Errors: a spacing or an angle
/// that makes no sense (usage), cancelled.
[[nodiscard]] Result<std::vector<Line>> hatch_lines(const Job& job,
                                                    std::span<const SectionPlane> planes,
                                                    const parallel::Context& context);

}  // namespace strake::hlr
