// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "strake/parallel/transform.hpp"

namespace strake::parallel {

/// A vector of n values for a loop of the team to write, its memory provided by the whole team: a
/// vector of a hundred megabytes keeps the thread that makes it busy for as long as the loop.
///
///     Result<std::vector<Point>> points = slots<Point>(n, context);
///     if (!points) return points.error();
///     const Status status = for_each(context, {.name = "points", .n = n},
///                                    [&](std::size_t i) { (*points)[i] = point(i); });
///
/// T must be default-constructible, by a constructor that does not throw, and not bool (bits cannot
/// be written concurrently: use std::uint8_t). Errors: out of memory, cancelled.
template <class T>
[[nodiscard]] Result<std::vector<T>> slots(std::size_t n, const Context& context) {
  return detail::slots<T>(n, context);
}

}  // namespace strake::parallel
