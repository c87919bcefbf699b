// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

#include "strake/parallel/for_each.hpp"

namespace strake::geometry {

/// From as many triangles, vertices or edges on, working on one part is worth a team. Below it
/// nothing is spent on asking for one.
inline constexpr std::size_t kWorthATeam = std::size_t{1} << 16U;
/// Items of such a loop that a worker takes at once.
inline constexpr std::size_t kTeamGrain = std::size_t{1} << 12U;

/// Calls body(i) for i in [0, n), each item on its own: with a team's help where that is worth it.
/// Errors: cancelled.
template <class Body>
[[nodiscard]] Status heavy_loop(const parallel::Context& context, std::string_view name,
                                std::size_t n, Body&& body) {
  if (n >= kWorthATeam)
    return parallel::for_each(context, {.name = name, .n = n, .grain = kTeamGrain}, body);
  for (std::size_t i = 0; i < n; ++i) body(i);
  return {};
}

}  // namespace strake::geometry
