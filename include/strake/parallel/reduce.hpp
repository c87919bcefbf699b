// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "strake/parallel/for_each.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::parallel {

/// Folds all items into one value, in an order that depends on (n, grain) only.
///
///     const Result<double> area = reduce(context, {.name = "area", .n = n, .grain = 1024}, 0.0,
///         [&](double& partial, std::size_t i) { partial += face_area(i); },
///         [](double& into, const double& partial) { into += partial; });
///
/// body(partial, i) adds item i to the partial of its block, which starts as a copy of `identity`
/// and sees the block's items in ascending order; combine(into, partial) then folds the partials
/// in block order on the calling thread. So sums of floating-point numbers have the same bits for
/// any team and schedule (not for another grain). T must be default-constructible and not bool.
/// Errors as in for_each; an exception of combine names the first item of its block.
///
/// There is one partial per block: give cheap items a grain of hundreds or thousands.
template <class T, class Body, class Combine>
[[nodiscard]] Result<T> reduce(const Context& context, const Region& region, const T& identity,
                               Body&& body, Combine&& combine) {
  static_assert(!std::is_same_v<T, bool>, "bits cannot be written concurrently: use uint8_t");
  static_assert(!std::is_invocable_v<Body&, T, std::size_t>,
                "the body takes its partial by reference, T& or auto&: to a copy sums are lost");
  static_assert(!std::is_invocable_v<Combine&, T, const T&>,
                "combine changes its first argument, T& or auto&; it is no std::plus");
  detail::require_shareable<Body, T&, std::size_t>();
  const std::size_t size = region.block_size();
  const auto fold = [&](std::span<T> partials) -> Result<T> {
    std::size_t block = 0;
    try {
      T total = identity;
      for (; block < partials.size(); ++block) combine(total, std::as_const(partials[block]));
      return total;
    } catch (...) {
      return detail::error_of_current_exception(region.name, block * size);
    }
  };
  if (region.is_short()) {
    try {
      T value = identity;
      Status status = detail::run_alone(
          region, [&](std::size_t i) -> decltype(auto) { return body(value, i); });
      if (!status) return std::move(status).error();
      return fold(std::span(&value, region.blocks()));
    } catch (...) {
      return detail::error_of_current_exception(region.name, 0);
    }
  }
  Result<std::vector<T>> partials = slots<T>(region.blocks());
  if (!partials) return std::move(partials).error();
  detail::RegionRun run(context, region);
  Status status = run.run([&](detail::RegionCursor& cursor) {
    detail::Range range;
    while (run.next(cursor, range)) {
      std::size_t i = range.first;
      try {
        for (bool good = true; good && i < range.last && i < run.limit();) {
          const std::size_t block = i / size;
          const std::size_t last = detail::block_end(i, size, range.last);
          T partial = identity;
          good = run.each(i, last, [&](std::size_t item) {
            return detail::run_item(run, item, body, partial, item);
          });
          (*partials)[block] = std::move(partial);
        }
      } catch (...) {
        run.fail_with_current_exception(i);
      }
    }
  });
  if (!status) return std::move(status).error();
  return fold(*partials);
}

}  // namespace strake::parallel
