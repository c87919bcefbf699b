// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace strake::geometry {

/// Returns numbers sorted by their keys, which are below `keys`; the sort is stable. It counts,
/// unless there are few numbers for so many keys.
template <class Key>
void counting_sort(std::vector<std::uint32_t>& numbers, std::size_t keys, Key&& key) {
  if (numbers.size() < keys / 16) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> ranked(numbers.size());
    for (std::uint32_t i = 0; i < numbers.size(); ++i) ranked[i] = {key(numbers[i]), i};
    std::ranges::sort(ranked);
    std::vector<std::uint32_t> sorted(numbers.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) sorted[i] = numbers[ranked[i].second];
    numbers = std::move(sorted);
    return;
  }
  std::vector<std::uint32_t> next(keys + 1, 0);
  for (const std::uint32_t n : numbers) ++next[key(n) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<std::uint32_t> sorted(numbers.size());
  for (const std::uint32_t n : numbers) sorted[next[key(n)]++] = n;
  numbers = std::move(sorted);
}

/// Returns the numbers 0 to n - 1.
[[nodiscard]] inline std::vector<std::uint32_t> index_sequence(std::size_t n) {
  std::vector<std::uint32_t> numbers(n);
  std::iota(numbers.begin(), numbers.end(), std::uint32_t{0});
  return numbers;
}

}  // namespace strake::geometry
