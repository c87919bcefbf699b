// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/slots.hpp"

namespace strake::hlr {

/// A run of elements of one of two arrays.
struct ElementRun {
  std::size_t first = 0, last = 0;
  bool fresh = false;  ///< of the new array
  [[nodiscard]] std::size_t size() const { return last - first; }
};

/// Puts runs together, of `kept` in ascending order and of `fresh` in any. They stay in their
/// memory where that holds them, as most of a drawing does not change. Errors: cancelled, out of
/// memory; then `kept` is of no use.
template <class T>
[[nodiscard]] Status splice(std::span<const ElementRun> runs, std::span<const T> fresh,
                            std::vector<T>& kept, const parallel::Context& context) {
  std::vector<std::size_t> begin(runs.size() + 1);
  for (std::size_t r = 0; r < runs.size(); ++r) begin[r + 1] = begin[r] + runs[r].size();
  const std::size_t total = begin.back();
  if (total <= kept.capacity()) {
    const auto move = [&](std::size_t r, bool up) {
      if (runs[r].fresh || (begin[r] > runs[r].first) != up || begin[r] == runs[r].first) return;
      const auto from = kept.begin() + static_cast<std::ptrdiff_t>(runs[r].first);
      const auto end = kept.begin() + static_cast<std::ptrdiff_t>(runs[r].last);
      const auto to = kept.begin() + static_cast<std::ptrdiff_t>(begin[r]);
      if (up)
        std::move_backward(from, end, to + static_cast<std::ptrdiff_t>(runs[r].size()));
      else
        std::move(from, end, to);
    };
    // What goes up makes room from the end on, what goes down from the start on: no run is
    // overwritten before it is moved.
    if (total > kept.size()) kept.resize(total);
    for (std::size_t r = runs.size(); r-- > 0;) move(r, true);
    for (std::size_t r = 0; r < runs.size(); ++r) move(r, false);
    for (std::size_t r = 0; r < runs.size(); ++r)
      if (runs[r].fresh)
        std::ranges::copy(fresh.subspan(runs[r].first, runs[r].size()),
                          kept.begin() + static_cast<std::ptrdiff_t>(begin[r]));
    kept.resize(total);
    return {};
  }
  auto all = parallel::slots<T>(total, context);
  if (!all) return all.error();
  /// Only shares the work out: between 16'384 and 262'144 no difference can be seen (decision
  /// 0073).
  constexpr std::size_t kBlock = 65536;
  const Status status = parallel::for_each(
      context, {.name = "what stays of a drawing", .n = (total + kBlock - 1) / kBlock},
      [&](std::size_t block) {
        std::size_t at = block * kBlock;
        const std::size_t end = std::min(total, at + kBlock);
        auto r = static_cast<std::size_t>(std::ranges::upper_bound(begin, at) - begin.begin()) - 1;
        for (; at < end; ++r) {
          const std::size_t count = std::min(end, begin[r + 1]) - at;
          const std::span<const T> from = runs[r].fresh ? fresh : std::span<const T>(kept);
          std::ranges::copy(from.subspan(runs[r].first + (at - begin[r]), count),
                            all->begin() + static_cast<std::ptrdiff_t>(at));
          at += count;
        }
      });
  if (!status) return status;
  kept = std::move(*all);
  return {};
}

}  // namespace strake::hlr
