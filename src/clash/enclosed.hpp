// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "clash/narrow_stage.hpp"

namespace strake::clash {

/// Marks the cases (Candidate::in_open) that are apart as far as skins tell, but where one part
/// lies within the other, an open surface that nearly encloses what it surrounds: meant as a solid,
/// it would hit. Those that touch there are UNCERTAIN instead, and may be a HIT. After all answers
/// are there. Errors: cancelled.
[[nodiscard]] Status mark_enclosed(const Stage& stage, std::vector<Candidate>& candidates);

}  // namespace strake::clash
