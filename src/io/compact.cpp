// SPDX-License-Identifier: Apache-2.0
#include "io/compact.hpp"

#include <algorithm>

namespace strake::io {
namespace {

/// The usual case: the vertices of an object stand together, a table over their range is small.
std::vector<std::uint32_t> compact_by_table(std::vector<std::uint32_t>& indices, std::uint32_t low,
                                            std::size_t range) {
  constexpr std::uint32_t kUnused = 0xffffffffU;
  std::vector<std::uint32_t> number(range, kUnused), used;
  for (const std::uint32_t index : indices) number[index - low] = 0;
  for (std::size_t i = 0; i < range; ++i) {
    if (number[i] == kUnused) continue;
    number[i] = static_cast<std::uint32_t>(used.size());
    used.push_back(low + static_cast<std::uint32_t>(i));
  }
  for (std::uint32_t& index : indices) index = number[index - low];
  return used;
}

}  // namespace

std::vector<std::uint32_t> compact_indices(std::vector<std::uint32_t>& indices) {
  if (indices.empty()) return {};
  const auto [least, most] = std::minmax_element(indices.begin(), indices.end());
  const std::uint32_t low = *least;
  const std::size_t range = std::size_t{*most} - low + 1;
  if (range / 4 <= indices.size()) return compact_by_table(indices, low, range);
  std::vector<std::uint32_t> used = indices;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (std::uint32_t& index : indices)
    index = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), index) -
                                       used.begin());
  return used;
}

}  // namespace strake::io
