// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "strake/parallel/for_each.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::parallel {

/// Lists of unequal length end to end: list i is values[offsets[i] .. offsets[i+1]).
template <class T>
struct Packed {
  std::vector<std::size_t> offsets{0};
  std::vector<T> values;

  [[nodiscard]] std::size_t size() const { return offsets.size() - 1; }
  [[nodiscard]] std::span<const T> operator[](std::size_t i) const {
    return std::span<const T>(values).subspan(offsets[i], offsets[i + 1] - offsets[i]);
  }
};

/// Packed lists in two passes: count(i) says how many values item i has, then fill(i, out) writes
/// exactly that many into its own part of the final memory. Nothing is moved or reallocated while
/// workers write. Choose it over collect when counting is cheap. Errors as in for_each; those of
/// the first pass come first.
template <class T, class Count, class Fill>
[[nodiscard]] Result<Packed<T>> count_fill(const Context& context, const Region& region,
                                           Count&& count, Fill&& fill) {
  static_assert(!std::is_same_v<T, bool>, "bits cannot be written concurrently: use uint8_t");
  detail::require_shareable<Count, std::size_t>();
  detail::require_shareable<Fill, std::size_t, std::span<T>>();
  Result<std::vector<std::size_t>> offsets = detail::offsets(region.n);
  if (!offsets) return std::move(offsets).error();
  std::vector<std::size_t>& at = *offsets;
  Status counted = for_each(context, region, [&](std::size_t i) { at[i + 1] = count(i); });
  if (!counted) return std::move(counted).error();
  if (Status summed = detail::prefix_sum(context, at); !summed) return std::move(summed).error();
  Result<std::vector<T>> values = unset_slots<T>(at[region.n], context);
  if (!values) return std::move(values).error();
  const std::span<T> all(*values);
  Status filled = for_each(context, region, [&](std::size_t i) {
    return fill(i, all.subspan(at[i], at[i + 1] - at[i]));
  });
  if (!filled) return std::move(filled).error();
  return Packed<T>{std::move(at), std::move(*values)};
}

}  // namespace strake::parallel
