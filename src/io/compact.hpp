// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace strake::io {

/// Renumbers indices from 0 in their ascending order and returns what each new number stood for:
/// how an object takes its own vertices out of a pool that many share. Time and memory follow the
/// number of indices, never the size of the pool.
[[nodiscard]] std::vector<std::uint32_t> compact_indices(std::vector<std::uint32_t>& indices);

}  // namespace strake::io
