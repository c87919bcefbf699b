// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "strake/parallel/for_each.hpp"
#include "strake/parallel/slots.hpp"

namespace strake::parallel {

namespace detail {

template <class T>
struct Unwrapped {
  using type = T;
};
template <class T>
struct Unwrapped<Result<T>> {
  using type = T;
};
template <class T>
using unwrapped_t = typename Unwrapped<std::remove_cvref_t<T>>::type;

/// Refuses results that cannot lie in a slot.
template <class Returned>
consteval void require_value() {
  static_assert(!std::is_void_v<unwrapped_t<Returned>> &&
                    !std::is_same_v<std::remove_cvref_t<Returned>, Error>,
                "it returns a value, or a Result of one: of a Status nothing would be kept");
}

}  // namespace detail

/// One result per item, at the item's index: body(worker_context, i) returns T or Result<T>.
/// T must be default-constructible and not bool (bits of a vector<bool> cannot be written
/// concurrently; use std::uint8_t). Errors, exceptions and the stop token as in for_each; there is
/// no half result.
template <class Make, class Body>
[[nodiscard]] auto transform_with(const Context& context, const Region& region, Make&& make,
                                  Body&& body) {
  detail::require_context<Make>();
  using Local = std::invoke_result_t<Make&>;
  using Returned = std::invoke_result_t<Body&, Local&, std::size_t>;
  detail::require_shareable<Body, Local&, std::size_t>();
  detail::require_value<Returned>();
  using T = detail::unwrapped_t<Returned>;
  static_assert(!std::is_same_v<T, bool>, "bits cannot be written concurrently: return uint8_t");
  Result<std::vector<T>> results = unset_slots<T>(region.n, context);
  if (!results) return results;
  std::vector<T>& slot = *results;
  Status status = for_each_with(context, region, make, [&](Local& local, std::size_t i) -> Status {
    if constexpr (std::is_same_v<std::remove_cvref_t<Returned>, T>) {
      slot[i] = body(local, i);
    } else {
      Result<T> one = body(local, i);
      if (!one) return std::move(one).error();
      slot[i] = std::move(one).value();
    }
    return {};
  });
  if (!status) return Result<std::vector<T>>(std::move(status).error());
  return results;
}

/// The same for a body(i) that needs no worker context.
template <class Body>
[[nodiscard]] auto transform(const Context& context, const Region& region, Body&& body) {
  static_assert(std::is_invocable_v<Body&, std::size_t>, "the body is called as body(i)");
  detail::require_shareable<Body, std::size_t>();
  return transform_with(
      context, region, [] { return NoContext{}; },
      [&body](NoContext&, std::size_t i) { return body(i); });
}

}  // namespace strake::parallel
