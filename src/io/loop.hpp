// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "strake/parallel/context.hpp"

namespace strake::io {

/// Calls body(i) for i in [0, n), each on whatever worker is free. False when stopped before all
/// were done.
template <class Body>
[[nodiscard]] bool for_each_index(const parallel::Context& context, std::size_t n, Body&& body) {
  for (std::size_t i = 0; i < n; ++i) {
    if (context.stop.stop_requested()) return false;
    body(i);
  }
  return true;
}

}  // namespace strake::io
