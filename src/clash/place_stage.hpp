// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "clash/narrow_stage.hpp"
#include "clash/places.hpp"

namespace strake::clash {

/// By case: the places of its parts, where regions or rules ask to tell them apart; none where the
/// answer as a whole is all there is to tell. Marks the candidates whose places are too near each
/// other to be told. Errors: cancelled.
[[nodiscard]] Result<std::vector<std::vector<PartPlace>>> tell_places(
    const Stage& stage, const Judged& judged, std::vector<Candidate>& candidates);

}  // namespace strake::clash
