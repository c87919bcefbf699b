// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/slots.hpp"

namespace strake::parallel {

namespace detail {

/// Where each row of a ragged table begins in one flat range, and the end. Errors: out of memory,
/// more elements than can be counted, an exception of length.
template <class Length>
Result<std::vector<std::size_t>> row_starts(const Context& context, std::string_view region,
                                            std::size_t rows, Length&& length) {
  Result<std::vector<std::size_t>> start = offsets(rows);
  if (!start) return start;
  for (std::size_t r = 0; r < rows; ++r) {
    Status status = status_of(region, r, [&] { (*start)[r + 1] = length(r); });
    if (!status) return std::move(status).error();
  }
  if (Status summed = prefix_sum(context, *start); !summed) return std::move(summed).error();
  return start;
}

/// The row that holds an element; finds the next one from the last quickly.
class RowFinder {
 public:
  explicit RowFinder(const std::vector<std::size_t>& start) : start_(start) {}

  std::size_t operator()(std::size_t flat) {
    if (flat >= start_[row_] && flat < start_[row_ + 1]) return row_;
    if (flat == start_[row_ + 1] && flat < start_[row_ + 2]) return ++row_;
    const auto after = std::ranges::upper_bound(start_, flat);
    return row_ = static_cast<std::size_t>(after - start_.begin()) - 1;
  }

 private:
  const std::vector<std::size_t>& start_;
  std::size_t row_ = 0;
};

}  // namespace detail

/// Two nested loops of which the inner one is of another length for each row, objects and their
/// primitives for instance, as one flat range: body(row, column) for every column below
/// length(row), so that a row of a million among a million rows of ten costs no balance.
///
///     const Status status = for_each_nested(
///         context, {.name = "primitives", .grain = 1024}, objects.size(),
///         [&](std::size_t o) { return objects[o].primitives.size(); },
///         [&](std::size_t o, std::size_t p) { boxes[o][p] = box_of(objects[o].primitives[p]); });
///
/// The region's n is that of all elements and set here. Rows in order, columns within them; blocks,
/// errors and the stop token as in for_each, the number in a caught exception's place being that of
/// the element among all, or of the row if it is length that throws. One word of memory per row.
template <class Length, class Body>
[[nodiscard]] Status for_each_nested(const Context& context, Region region, std::size_t rows,
                                     Length&& length, Body&& body) {
  detail::require_shareable<Body, std::size_t, std::size_t>();
  auto start = detail::row_starts(context, region.name, rows, length);
  if (!start && context.stop.stop_requested()) return detail::cancelled_error();
  if (!start) return std::move(start).error();
  region.n = start->back();
  return for_each_with(
      context, region, [&] { return detail::RowFinder(*start); },
      [&](detail::RowFinder& row_of, std::size_t flat) -> decltype(auto) {
        const std::size_t row = row_of(flat);
        return body(row, flat - (*start)[row]);
      });
}

}  // namespace strake::parallel
