// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "strake/model/scene.hpp"

namespace strake::hlr {

/// Every code that a Defect may have.
inline constexpr std::array<std::string_view, 10> kDefectCodes{
    "only-points",        "no-lines",          "object-skipped",     "object-incomplete",
    "body-without-shape", "mesh-bad-triangle", "polyline-bad-point", "body-unplaceable",
    "shape-unplaceable",  model::kVanished};

/// Returns the literal of a code that was read from a file; empty for one that is none.
[[nodiscard]] inline std::string_view defect_code(std::string_view text) {
  const auto* const found = std::ranges::find(kDefectCodes, text);
  return found == kDefectCodes.end() ? std::string_view() : *found;
}

}  // namespace strake::hlr
