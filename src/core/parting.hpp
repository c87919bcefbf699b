// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0123 says why nothing else calls std::nth_element or std::partition.

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>

namespace strake {

/// Moves the items of which `goes_first` holds to the front, and returns their number. The order
/// within either side follows from the order before, by this loop alone: that of std::partition is
/// each standard library's own.
template <class T, class GoesFirst>
std::size_t part_by(std::span<T> items, GoesFirst&& goes_first) {
  std::size_t first = 0, last = items.size();
  while (true) {
    while (first < last && goes_first(std::as_const(items[first]))) ++first;
    while (first < last && !goes_first(std::as_const(items[last - 1]))) --last;
    if (first == last) return first;
    std::swap(items[first++], items[--last]);
  }
}

/// Moves the least `count` items to the front, and behind them, where there are more, the least of
/// the others. `less` tells any two items apart, so that these are
/// the same ones everywhere; the order within either side is each standard library's own, and
/// whoever looks at it sorts it first. Built with STRAKE_OTHER_ORDER it is another one, so that
/// tests show who does not.
template <class T, class Less>
void part_at(std::span<T> items, std::size_t count, Less&& less) {
  const auto middle = items.begin() + static_cast<std::ptrdiff_t>(count);
  std::nth_element(items.begin(), middle, items.end(), less);
#ifdef STRAKE_OTHER_ORDER
  std::reverse(items.begin(), middle);
  if (middle != items.end()) std::reverse(middle + 1, items.end());
#endif
}

/// Returns the value that would be the n-th in ascending order, and moves all about.
template <class T>
[[nodiscard]] T nth_value(std::span<T> values, std::size_t n) {
  part_at(values, n, std::less());
  return values[n];
}

}  // namespace strake
