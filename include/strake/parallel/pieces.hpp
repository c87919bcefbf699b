// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/parallel/detail/current_exception.hpp"

namespace strake::parallel {

/// A run of the elements of an item: [first, last).
struct Piece {
  std::uint32_t item = 0;
  std::size_t first = 0, last = 0;

  [[nodiscard]] std::size_t size() const { return last - first; }
  friend bool operator==(const Piece&, const Piece&) = default;
};

/// Calls visit(first, last) for runs that cut [0, count) into as few as can be of at most `limit`
/// elements each, ascending; their sizes differ by one at most. None for nothing; a limit of 0
/// counts as 1.
template <std::unsigned_integral Number, class Visit>
void cut_evenly(Number count, Number limit, Visit&& visit) {
  const Number size = std::max<Number>(limit, 1);
  const Number runs = count / size + (count % size != 0 ? 1 : 0);
  for (Number k = 0, first = 0; k < runs; ++k) {
    const Number last = first + count / runs + (k < count % runs ? 1 : 0);
    visit(first, last);
    first = last;
  }
}

/// Items of unequal size cut into pieces of at most `limit` elements, so that one giant among them
/// does not keep a worker busy while the others wait: the pieces, not the items, are what a region
/// runs over.
///
///     const auto edges = [&](std::size_t m) { return meshes[m].edges.size(); };
///     const Result<std::vector<Piece>> work = pieces(meshes.size(), edges, 1024);
///     if (!work) return work.error();
///     return for_each(context, {.name = "edges", .n = work->size()}, [&](std::size_t k) {
///       const Piece& piece = (*work)[k];
///       for (std::size_t e = piece.first; e < piece.last; ++e) draw(meshes[piece.item], e);
///     });
///
/// By item, then ascending; an item without elements has none. They depend on the sizes and the
/// limit alone, so results by piece are the same for any team. Fewer than 2^32 items. Errors: out
/// of memory, an exception of count.
template <class Count>
[[nodiscard]] Result<std::vector<Piece>> pieces(std::size_t n, Count&& count, std::size_t limit) {
  std::size_t i = 0;
  try {
    std::vector<Piece> all;
    for (; i < n; ++i)
      cut_evenly(static_cast<std::size_t>(count(i)), limit,
                 [&](std::size_t first, std::size_t last) {
                   all.push_back({static_cast<std::uint32_t>(i), first, last});
                 });
    return all;
  } catch (...) {
    return detail::error_of_current_exception("pieces", i);
  }
}

}  // namespace strake::parallel
