// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

#include "strake/parallel/region.hpp"

namespace strake::hlr {

/// The number of triangles, edges or vertices of one shape that is worth a team. With this and the
/// next, loops of more than 50 ms over a mesh of a million triangles among 20,000 bodies keep two
/// workers busy to 0.94 to 1.00 (docs/patterns/pieces.md).
inline constexpr std::size_t kBigShape = std::size_t{1} << 15U;
/// The number of elements that a worker takes at a time.
inline constexpr std::size_t kElements = 2048;

/// Returns a loop over the elements of one shape. The whole team runs it where the shape is big, so
/// that one imported mesh does not keep a worker busy while the others wait.
[[nodiscard]] inline parallel::Region over_elements(std::string_view name, std::size_t n) {
  return {.name = name, .n = n, .grain = kElements, .alone_below = kBigShape};
}

}  // namespace strake::hlr
