// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "strake/parallel/for_each.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::parallel {

namespace detail {

/// Where the results of one block lie among those of the worker that ran it.
struct Piece {
  unsigned worker = 0;
  std::size_t first = 0, count = 0;
};

template <class T>
Result<std::vector<T>> gather(std::span<const Piece> pieces, std::span<std::vector<T>> of_worker) {
  std::size_t total = 0;
  for (const Piece& piece : pieces) total += piece.count;
  try {
    std::vector<T> all;
    all.reserve(total);
    for (const Piece& piece : pieces) {
      const auto from = of_worker[piece.worker].begin() + static_cast<std::ptrdiff_t>(piece.first);
      all.insert(all.end(), std::make_move_iterator(from),
                 std::make_move_iterator(from + static_cast<std::ptrdiff_t>(piece.count)));
    }
    return all;
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

}  // namespace detail

/// Any number of results per item, in the order of the items: body(worker_context, i, out)
/// appends to `out`, a std::vector<T>& that it must otherwise leave alone.
///
///     Result<std::vector<Pair>> pairs = collect<Pair>(context, {.name = "pairs", .n = n},
///         [&](std::size_t i, std::vector<Pair>& out) { ... out.push_back(...) ... });
///
/// Workers append to vectors of their own without a lock; at the end the blocks are put together
/// in ascending order, so the result is the same for any team. Errors as in for_each.
template <class T, class Make, class Body>
[[nodiscard]] Result<std::vector<T>> collect_with(const Context& context, const Region& region,
                                                  Make&& make, Body&& body) {
  using Local = std::invoke_result_t<Make&>;
  const unsigned workers = context.team != nullptr ? context.team->size() : 1;
  Result<std::vector<detail::Piece>> pieces = detail::slots<detail::Piece>(region.blocks());
  if (!pieces) return pieces.error();
  std::vector<std::vector<T>> of_worker(workers);
  const std::size_t size = region.block_size();
  detail::RegionRun run(context, region);
  const Status status = run.run([&](detail::Cursor& cursor) {
    std::optional<Local> local;
    // On the worker's own stack while it grows: neighbours in of_worker share cache lines.
    std::vector<T> out;
    detail::Range range;
    while (run.next(cursor, range)) {
      std::size_t i = range.first;
      try {
        if (!local) local.emplace(make());
        for (bool good = true; good && i < range.last && i < run.limit();) {
          const std::size_t first = out.size();
          const std::size_t block = i / size;
          const std::size_t last = std::min(range.last, (block + 1) * size);
          for (; good && i < last && i < run.limit(); ++i)
            good = detail::run_item(run, i, body, *local, i, out);
          (*pieces)[block] = {cursor.seat.index, first, out.size() - first};
        }
      } catch (...) {
        run.fail_with_current_exception(i);
      }
    }
    of_worker[cursor.seat.index] = std::move(out);
  });
  if (!status) return status.error();
  return detail::gather<T>(*pieces, of_worker);
}

/// The same for a body(i, out) that needs no worker context.
template <class T, class Body>
[[nodiscard]] Result<std::vector<T>> collect(const Context& context, const Region& region,
                                             Body&& body) {
  return collect_with<T>(
      context, region, [] { return NoContext{}; },
      [&body](NoContext&, std::size_t i, std::vector<T>& out) { return body(i, out); });
}

}  // namespace strake::parallel
