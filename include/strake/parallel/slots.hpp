// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "strake/parallel/detail/first_touch.hpp"

namespace strake::parallel {

/// A vector of n values for a loop of the team to write, its memory provided by the whole team: a
/// vector of a hundred megabytes keeps the thread that makes it busy for as long as the loop.
///
///     Result<std::vector<Point>> points = slots<Point>(n, context);
///     if (!points) return points.error();
///     const Status status = for_each(context, {.name = "points", .n = n},
///                                    [&](std::size_t i) { (*points)[i] = point(i); });
///
/// T must be default-constructible and not bool (bits cannot be written concurrently: use
/// std::uint8_t). Errors: out of memory, which a constructor that throws counts as; cancelled.
template <class T>
[[nodiscard]] Result<std::vector<T>> slots(std::size_t n, const Context& context = {}) {
  static_assert(!std::is_same_v<T, bool>, "bits cannot be written concurrently: use uint8_t");
  try {
    std::vector<T> values;
    values.reserve(n);
    Status status = detail::provide_pages(context, values.data(), n * sizeof(T));
    if (!status) return std::move(status).error();
    values.resize(n);
    return values;
  } catch (...) {
    return out_of_memory();
  }
}

namespace detail {

/// n + 1 zeros, for where each of n lists begins and the last one ends. Errors: out of memory.
[[nodiscard]] inline Result<std::vector<std::size_t>> offsets(std::size_t n) {
  if (n == std::numeric_limits<std::size_t>::max()) return out_of_memory();
  return slots<std::size_t>(n + 1);
}

/// Makes offsets of lengths: lengths[i + 1], the length of list i, becomes where it ends. Errors:
/// more values in all than can be counted.
[[nodiscard]] inline Status sum_up(std::span<std::size_t> lengths) {
  for (std::size_t i = 1; i < lengths.size(); ++i) {
    if (lengths[i] > std::numeric_limits<std::size_t>::max() - lengths[i - 1])
      return Error{ErrorCode::input, "more elements than can be counted", {}, {}};
    lengths[i] += lengths[i - 1];
  }
  return {};
}

}  // namespace detail
}  // namespace strake::parallel
