// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace strake::geometry {

// Corners and edges of a triangle by their numbers, 0 to 2: edge i runs from corner i to the next.

[[nodiscard]] constexpr int next_corner(int i) { return i == 2 ? 0 : i + 1; }
[[nodiscard]] constexpr std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace strake::geometry
