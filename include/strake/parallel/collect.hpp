// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <new>
#include <numeric>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "strake/parallel/for_each.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::parallel {

namespace detail {

/// Results of some blocks, as one worker made them.
template <class T>
struct Chunk {
  struct Part {
    std::size_t block = 0, first = 0;  ///< index into items
  };
  std::vector<T> items;
  std::vector<Part> parts;
};

/// A worker hands over what it has when a block has made it so large: then less is moved to grow.
/// Between 1 MiB and 16 MiB no difference can be seen (decision 0073).
inline constexpr std::size_t kChunkBytes = std::size_t{4} << 20U;

/// Puts chunks together. `first`: by block, the index of its first result, and one more.
template <class T>
Result<std::vector<T>> put_together(const Context& context, std::span<Chunk<T>> chunks,
                                    std::span<const std::size_t> first) {
  Result<std::vector<T>> all = unset_slots<T>(first.back(), context);
  if (!all) return all;
  const auto move_chunk = [&](std::size_t c) {
    Chunk<T> chunk = std::exchange(chunks[c], {});
    for (const typename Chunk<T>::Part& part : chunk.parts) {
      const std::size_t count = first[part.block + 1] - first[part.block];
      const auto from = chunk.items.begin() + static_cast<std::ptrdiff_t>(part.first);
      std::move(from, from + static_cast<std::ptrdiff_t>(count),
                all->begin() + static_cast<std::ptrdiff_t>(first[part.block]));
    }
  };
  const bool few = first.back() * sizeof(T) < kChunkBytes;
  Status status = for_each(few ? Context{.stop = context.stop} : context,
                           {.name = "results put together", .n = chunks.size()}, move_chunk);
  if (!status) return std::move(status).error();
  return all;
}

}  // namespace detail

/// Any number of results per item, in the order of the items: body(worker_context, i, out)
/// appends to `out`, a std::vector<T>& that it must otherwise leave alone.
///
///     Result<std::vector<Pair>> pairs = collect<Pair>(context, {.name = "pairs", .n = n},
///         [&](std::size_t i, std::vector<Pair>& out) { ... out.push_back(...) ... });
///
/// Workers append to vectors of their own without a lock; at the end the blocks are put together
/// in ascending order, so the result is the same for any team. T must be default-constructible.
/// Errors as in for_each.
template <class T, class Make, class Body>
[[nodiscard]] Result<std::vector<T>> collect_with(const Context& context, const Region& region,
                                                  Make&& make, Body&& body) {
  static_assert(!std::is_same_v<T, bool>, "bits cannot be written concurrently: use uint8_t");
  using Local = std::invoke_result_t<Make&>;
  static_assert(std::is_invocable_v<Body&, Local&, std::size_t, std::vector<T>&>,
                "the body is called as body(worker_context, i, out)");
  static_assert(
      !std::is_invocable_v<Body&, Local&, std::size_t, std::vector<T>>,
      "the body takes out by reference, std::vector<T>& or auto&: to a copy results are lost");
  detail::require_shareable<Body, Local&, std::size_t, std::vector<T>&>();
  if (region.is_short()) {
    std::vector<T> out;
    Status status = for_each_with(
        context, region, make,
        [&](Local& local, std::size_t i) -> decltype(auto) { return body(local, i, out); });
    if (!status) return std::move(status).error();
    return out;
  }
  const unsigned workers = context.team != nullptr ? context.team->size() : 1;
  // The number of results of each block, after its own place.
  Result<std::vector<std::size_t>> first = detail::offsets(region.blocks());
  if (!first) return std::move(first).error();
  auto of_worker = slots<std::vector<detail::Chunk<T>>>(workers);
  if (!of_worker) return std::move(of_worker).error();
  const std::size_t size = region.block_size();
  detail::RegionRun run(context, region);
  Status status = run.run([&](detail::RegionCursor& cursor) {
    std::optional<Local> local;
    // On the worker's own stack while it grows: neighbours in of_worker share cache lines.
    std::vector<detail::Chunk<T>> done;
    detail::Chunk<T> chunk;
    std::vector<T>& out = chunk.items;
    detail::Range range;
    while (run.next(cursor, range)) {
      std::size_t i = range.first;
      try {
        if (!local) local.emplace(make());
        for (bool good = true; good && i < range.last && i < run.limit();) {
          const std::size_t before = out.size();
          const std::size_t block = i / size;
          const std::size_t last = detail::block_end(i, size, range.last);
          good = run.each(i, last, [&](std::size_t item) {
            return detail::run_item(run, item, body, *local, item, out);
          });
          (*first)[block + 1] = out.size() - before;
          if (out.size() > before) chunk.parts.push_back({block, before});
          if (out.size() * sizeof(T) >= detail::kChunkBytes) {
            done.push_back(std::exchange(chunk, {}));
            out.reserve(detail::kChunkBytes / sizeof(T) * 5 / 4);
          }
        }
      } catch (...) {
        run.fail_with_current_exception(i);
      }
    }
    try {
      if (!out.empty()) done.push_back(std::move(chunk));
    } catch (...) {
      run.fail_with_current_exception(region.n);
    }
    (*of_worker)[cursor.seat.index] = std::move(done);
  });
  if (!status) return std::move(status).error();
  std::inclusive_scan(first->begin(), first->end(), first->begin());
  try {
    std::vector<detail::Chunk<T>> chunks;
    for (std::vector<detail::Chunk<T>>& of_one : *of_worker)
      std::move(of_one.begin(), of_one.end(), std::back_inserter(chunks));
    return detail::put_together<T>(context, chunks, *first);
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

/// The same for a body(i, out) that needs no worker context.
template <class T, class Body>
[[nodiscard]] Result<std::vector<T>> collect(const Context& context, const Region& region,
                                             Body&& body) {
  static_assert(std::is_invocable_v<Body&, std::size_t, std::vector<T>&>,
                "the body is called as body(i, out)");
  static_assert(
      !std::is_invocable_v<Body&, std::size_t, std::vector<T>>,
      "the body takes out by reference, std::vector<T>& or auto&: to a copy results are lost");
  detail::require_shareable<Body, std::size_t, std::vector<T>&>();
  return collect_with<T>(
      context, region, [] { return NoContext{}; },
      [&body](NoContext&, std::size_t i, std::vector<T>& out) { return body(i, out); });
}

}  // namespace strake::parallel
