// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "strake/parallel/for_each.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::parallel {

namespace detail {

/// Runs items until one's body(worker_context, i), which returns bool, says that it is the last.
/// Returns the lowest such item, or n. Items above it may have run, all below it have.
template <class Make, class Body>
Result<std::size_t> run_until(const Context& context, const Region& region, Make&& make,
                              Body&& body) {
  using Local = std::invoke_result_t<Make&>;
  if (region.is_short()) {
    std::size_t i = 0;
    try {
      for (std::optional<Local> local; i < region.n; ++i) {
        if (!local) local.emplace(make());
        if (body(*local, i)) break;
      }
    } catch (...) {
      return error_of_current_exception(region.name, i);
    }
    return i;
  }
  RegionRun run(context, region, Visit::ascending);
  Status status = run.run([&](RegionCursor& cursor) {
    std::optional<Local> local;
    Range range;
    while (run.next(cursor, range)) {
      std::size_t i = range.first;
      try {
        if (!local) local.emplace(make());
        if (!run.each(i, range.last, [&](std::size_t item) { return !body(*local, item); }))
          run.lower_limit(i);
      } catch (...) {
        run.fail_with_current_exception(i);
      }
    }
  });
  if (!status) return std::move(status).error();
  return std::min(run.limit(), region.n);
}

}  // namespace detail

/// The lowest item for which test(worker_context, i) holds; none if there is no such item. Items
/// above one that is known to hold are left out, those below it are all asked: the answer is that
/// of a sequential search for any team, schedule and order.
///
///     const Result<std::optional<std::size_t>> open = find_first(
///         context, {.name = "open edges", .n = edges.size(), .grain = 4096},
///         [&](std::size_t e) { return edges[e].triangles != 2; });
///
/// Exceptions and the stop token as in for_each; an exception of an item above the one found is
/// none that a sequential search would have met, and is dropped.
template <class Make, class Test>
[[nodiscard]] Result<std::optional<std::size_t>> find_first_with(const Context& context,
                                                                 const Region& region, Make&& make,
                                                                 Test&& test) {
  detail::require_context<Make>();
  detail::require_test<Test, std::invoke_result_t<Make&>&, std::size_t>();
  Result<std::size_t> found = detail::run_until(context, region, make, test);
  if (!found) return std::move(found).error();
  if (*found == region.n) return std::optional<std::size_t>();
  return std::optional(*found);
}

/// The same for a test(i) that needs no worker context.
template <class Test>
[[nodiscard]] Result<std::optional<std::size_t>> find_first(const Context& context,
                                                            const Region& region, Test&& test) {
  detail::require_test<Test, std::size_t>();
  return find_first_with(
      context, region, [] { return NoContext{}; },
      [&test](NoContext&, std::size_t i) { return test(i); });
}

/// Whether test(i) holds for every item; true of none. It ends soon after one that fails.
/// Exceptions and the stop token as in find_first.
template <class Test>
[[nodiscard]] Result<bool> all_of(const Context& context, const Region& region, Test&& test) {
  detail::require_test<Test, std::size_t>();
  Result<std::optional<std::size_t>> found =
      find_first(context, region, [&test](std::size_t i) { return !test(i); });
  if (!found) return std::move(found).error();
  return !found->has_value();
}

/// As transform, up to the first item whose result is the last that is wanted: body(i) returns T,
/// is_last(result) tells. The results are those of items 0 to that one, of all if there is none;
/// what was made of items above it is dropped, so that sums over the results are the same for any
/// team.
template <class Body, class IsLast>
[[nodiscard]] auto transform_until(const Context& context, const Region& region, Body&& body,
                                   IsLast&& is_last) {
  using T = std::remove_cvref_t<std::invoke_result_t<Body&, std::size_t>>;
  static_assert(!std::is_void_v<T>, "the body returns a value: of nothing nothing would be kept");
  static_assert(std::is_same_v<T, detail::unwrapped_t<T>> && !std::is_same_v<T, Error>,
                "the body returns a value, not a Result or Status");
  detail::require_shareable<Body, std::size_t>();
  detail::require_test<IsLast, const T&>();
  static_assert(!std::is_same_v<T, bool>, "bits cannot be written concurrently: return uint8_t");
  Result<std::vector<T>> results = unset_slots<T>(region.n, context);
  if (!results) return results;
  std::vector<T>& slot = *results;
  Result<std::size_t> last = detail::run_until(
      context, region, [] { return NoContext{}; },
      [&](NoContext&, std::size_t i) {
        slot[i] = body(i);
        return static_cast<bool>(is_last(std::as_const(slot[i])));
      });
  if (!last) return Result<std::vector<T>>(std::move(last).error());
  if (*last < region.n) slot.resize(*last + 1);
  return results;
}

}  // namespace strake::parallel
