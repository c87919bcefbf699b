// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0120 says why values are taken down by the whole team.

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "strake/parallel/detail/first_touch.hpp"
#include "strake/parallel/detail/unset_elements.hpp"
#include "strake/parallel/for_each.hpp"

namespace strake::parallel {

/// A vector of n values for a loop of the team to write, made by the whole team: a vector of a
/// hundred megabytes keeps the thread that makes it busy for as long as the loop.
///
///     Result<std::vector<Point>> points = slots<Point>(n, context);
///     if (!points) return points.error();
///     const Status status = for_each(context, {.name = "points", .n = n},
///                                    [&](std::size_t i) { (*points)[i] = point(i); });
///
/// T must be default-constructible and not bool (bits cannot be written concurrently: use
/// std::uint8_t). Errors: out of memory, which a constructor that throws counts as.
template <class T>
[[nodiscard]] Result<std::vector<T>> slots(std::size_t n, const Context& context = {}) {
  static_assert(!std::is_same_v<T, bool>, "bits cannot be written concurrently: use uint8_t");
  try {
    std::vector<T> values;
    values.reserve(n);
    if constexpr (detail::kCanLeaveUnset && std::is_nothrow_default_constructible_v<T>) {
      if (detail::is_worth_a_team(context, n, sizeof(T))) {
        T* const first = values.data();
        Status status = detail::for_each_run_of_memory(
            context, n, sizeof(T), [first](std::size_t begin, std::size_t end) {
              std::uninitialized_value_construct(first + begin, first + end);
            });
        if (!status) return std::move(status).error();
        detail::set_size_unset(values, n);
        return values;
      }
    }
    values.resize(n);
    return values;
  } catch (...) {
    return out_of_memory();
  }
}

/// The same for a loop that writes every one of the values before any is read: until then they have
/// none, so that nothing is written twice, and the workers that write memory are those that touch
/// it first. A type that is not trivially copyable has its default value, as in slots().
template <class T>
[[nodiscard]] Result<std::vector<T>> unset_slots(std::size_t n, const Context& context = {}) {
  if constexpr (detail::kCanLeaveUnset && detail::kIsPlain<T>) {
    static_assert(!std::is_same_v<T, bool>, "bits cannot be written concurrently: use uint8_t");
    try {
      std::vector<T> values;
      values.reserve(n);
      detail::set_size_unset(values, n);
      return values;
    } catch (...) {
      return out_of_memory();
    }
  } else {
    return slots<T>(n, context);
  }
}

/// Takes all values of a vector down, by the whole team: a million objects with strings keep the
/// thread that ends them busy for as long as reading them took all of it. Whatever the context's
/// stop token says, all values are gone; the memory of the vector itself stays its own.
/// The destructor of T must not throw.
template <class T>
void clear(std::vector<T>& values, const Context& context) noexcept {
  if constexpr (detail::kCanLeaveUnset && !std::is_trivially_destructible_v<T>) {
    if (detail::is_worth_a_team(context, values.size(), sizeof(T))) {
      T* const first = values.data();
      // All values, or none where there was no memory to share them out.
      const Status status = detail::for_each_run_of_memory(
          context, values.size(), sizeof(T), [first](std::size_t begin, std::size_t end) noexcept {
            std::destroy(first + begin, first + end);
          });
      if (status) detail::set_size_unset(values, 0);
    }
  }
  values.clear();
}

namespace detail {

/// n + 1 numbers for where each of n lists begins and the last one ends: the first is 0, the others
/// are unset. Errors: out of memory.
[[nodiscard]] inline Result<std::vector<std::size_t>> offsets(std::size_t n) {
  if (n == std::numeric_limits<std::size_t>::max()) return out_of_memory();
  Result<std::vector<std::size_t>> at = unset_slots<std::size_t>(n + 1);
  if (at) at->front() = 0;
  return at;
}

/// Makes offsets of lengths, by all workers: lengths[i + 1], the length of list i, becomes where it
/// ends; lengths[0] is 0. Errors: more values in all than can be counted; as in for_each.
[[nodiscard]] Status prefix_sum(const Context& context, std::span<std::size_t> lengths);

}  // namespace detail
}  // namespace strake::parallel
