// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "strake/parallel/detail/current_exception.hpp"
#include "strake/parallel/region.hpp"

namespace strake::parallel {

/// Worker context of patterns that need none.
struct NoContext {};

namespace detail {

/// Refuses functions that workers cannot call at the same time: a mutable lambda would change its
/// copies of what it captured, which is a race.
template <class Function, class... Args>
consteval void require_shareable() {
  static_assert(std::is_invocable_v<const std::remove_reference_t<Function>&, Args...>,
                "workers call it at the same time: no mutable lambda, a const call operator");
}

/// Refuses what makes no worker context.
template <class Make>
consteval void require_context() {
  static_assert(std::is_object_v<std::invoke_result_t<Make&>> &&
                    std::is_move_constructible_v<std::invoke_result_t<Make&>>,
                "make() returns a worker context, by value");
  require_shareable<Make>();
}

/// Refuses tests that may fail to answer: a Result is true when it holds an answer, be that no.
template <class Test, class... Args>
consteval void require_test() {
  static_assert(std::is_convertible_v<std::invoke_result_t<Test&, Args...>, bool>,
                "the test returns bool, not a Result or Status: an error would pass for an answer");
  require_shareable<Test, Args...>();
}

/// Calls body(args...) and tells whether to go on: body returns void or Status.
template <class Body, class... Args>
bool run_item(RegionRun& run, std::size_t item, Body& body, Args&&... args) {
  if constexpr (std::is_void_v<std::invoke_result_t<Body&, Args...>>) {
    body(std::forward<Args>(args)...);
    return true;
  } else {
    Status status = body(std::forward<Args>(args)...);
    if (status) return true;
    run.fail(item, std::move(status).error());
    return false;
  }
}

/// What became of an item that has another number in its region: body() returns void or Status, and
/// an exception names the item's own number.
template <class Body>
Status status_of(std::string_view region, std::size_t item, Body&& body) {
  try {
    if constexpr (std::is_void_v<std::invoke_result_t<Body&>>) {
      body();
      return {};
    } else {
      return body();
    }
  } catch (...) {
    return error_of_current_exception(region, item);
  }
}

/// The items of a short region (Region::alone_below), body(i) returning void or Status.
template <class Body>
Status run_alone(const Region& region, Body&& body) {
  std::size_t i = 0;
  try {
    for (; i < region.n; ++i) {
      if constexpr (std::is_void_v<std::invoke_result_t<Body&, std::size_t>>) {
        body(i);
      } else {
        if (Status status = body(i); !status) return status;
      }
    }
  } catch (...) {
    return error_of_current_exception(region.name, i);
  }
  return {};
}

}  // namespace detail

/// Calls body(worker_context, i) for every item of the region, on the context's team.
///
///     const Status status = for_each_with(
///         context, {.name = "local hidden lines", .n = objects.size()},
///         [] { return Scratch(); },
///         [&](Scratch& scratch, std::size_t i) { hide(objects[i], scratch, results[i]); });
///
/// `make()` gives a worker its own context: scratch memory, a generator, a handle. It is called on
/// that worker, once per region, and only when the worker gets an item. Its destructor must not
/// throw: that would end the program.
///
/// 1. Every item runs exactly once, unless an error or the stop token prevents it.
/// 2. A body returns void or Status; an exception is caught and counts as an error. An error stops
///    items of higher index only, so the error returned is that of the lowest failing item, for
///    any team and schedule.
/// 3. A triggered stop token returns ErrorCode::cancelled as soon as the running items end.
/// 4. Without a team the same loop runs on the calling thread.
///
/// Not promised: which worker runs an item, and what a worker's context has seen before. A result
/// must not depend on either: write to slot i, or use transform, collect, reduce.
///
/// Cost per item: less than a nanosecond, and for each chunk that of an atomic addition if dynamic.
template <class Make, class Body>
[[nodiscard]] Status for_each_with(const Context& context, const Region& region, Make&& make,
                                   Body&& body) {
  detail::require_context<Make>();
  using Local = std::invoke_result_t<Make&>;
  static_assert(std::is_invocable_v<Body&, Local&, std::size_t>,
                "the body is called as body(worker_context, i)");
  detail::require_shareable<Body, Local&, std::size_t>();
  if (region.is_short())
    return detail::run_alone(
        region, [&, local = std::optional<Local>()](std::size_t i) mutable -> decltype(auto) {
          if (!local) local.emplace(make());
          return body(*local, i);
        });
  detail::RegionRun run(context, region);
  return run.run([&](detail::RegionCursor& cursor) {
    std::optional<Local> local;
    detail::Range range;
    while (run.next(cursor, range)) {
      std::size_t i = range.first;
      try {
        if (!local) local.emplace(make());
        run.each(i, range.last,
                 [&](std::size_t item) { return detail::run_item(run, item, body, *local, item); });
      } catch (...) {
        run.fail_with_current_exception(i);
      }
    }
  });
}

/// The same for a body(i) that needs no worker context.
template <class Body>
[[nodiscard]] Status for_each(const Context& context, const Region& region, Body&& body) {
  static_assert(std::is_invocable_v<Body&, std::size_t>, "the body is called as body(i)");
  detail::require_shareable<Body, std::size_t>();
  return for_each_with(
      context, region, [] { return NoContext{}; },
      [&body](NoContext&, std::size_t i) { return body(i); });
}

}  // namespace strake::parallel
