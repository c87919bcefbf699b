// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "strake/geometry/part.hpp"

namespace strake::geometry {

inline constexpr std::uint32_t kNoShell = 0xffffffffU;

/// For each closed shell (each a solid part of positive volume) the smallest other shell that
/// contains it without being crossed by it, or kNoShell. Exact.
[[nodiscard]] std::vector<std::uint32_t> find_parents(std::span<const Part> shells);

}  // namespace strake::geometry
