// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace strake::geometry {

/// Number i of `count` items that are spread evenly over a list.
template <class List>
[[nodiscard]] const auto& sample(const List& list, std::size_t i, std::size_t count) {
  return list[i * list.size() / count];
}

}  // namespace strake::geometry
