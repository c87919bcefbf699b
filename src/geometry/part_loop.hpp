// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

#include "strake/parallel/region.hpp"

namespace strake::geometry {

/// From as many triangles, vertices or edges on, working on one part is worth a team. Below it
/// nothing is spent on asking for one.
inline constexpr std::size_t kWorthATeam = std::size_t{1} << 16U;
/// Items of such a loop that a worker takes at once.
inline constexpr std::size_t kTeamGrain = std::size_t{1} << 12U;

/// A loop over the triangles, vertices or edges of one part.
[[nodiscard]] inline parallel::Region over_part(std::string_view name, std::size_t n) {
  return {.name = name, .n = n, .grain = kTeamGrain, .alone_below = kWorthATeam};
}

}  // namespace strake::geometry
