// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "strake/parallel/for_each.hpp"

namespace strake::parallel {

/// What a run of for_each_reserved took.
struct ReservedRun {
  std::uint64_t rounds = 0;
  std::uint64_t claims = 0;  ///< calls of claim; more than the items by those that were in vain
};

/// Where an item of for_each_reserved names its places.
class Claims {
 public:
  explicit Claims(std::vector<std::size_t>& places) : places_(places) {}
  void operator()(std::size_t place) { places_.push_back(place); }

 private:
  std::vector<std::size_t>& places_;
};

namespace detail {
[[nodiscard]] Result<ReservedRun> run_reserved(const Context& context, const Region& region,
                                               std::size_t places,
                                               FunctionRef<bool(std::size_t, Claims&)> claim,
                                               FunctionRef<Status(std::size_t)> act);
}  // namespace detail

/// Items that change what they share, where the order of the changes counts: with the result that a
/// fixed order gives, for any team.
///
///     const Result<ReservedRun> run = for_each_reserved(
///         context, {.name = "quads", .n = edges.size(), .grain = 256}, triangles.size(),
///         [&](std::size_t i, Claims& claims) {
///           claims(edges[i].left);
///           claims(edges[i].right);
///           return free(edges[i].left) && free(edges[i].right);
///         },
///         [&](std::size_t i) { pair(edges[i].left, edges[i].right); });
///
/// Items pass in rounds, many at a time. First each names the places, of [0, places), that it will
/// read or write: the lowest item that requests a place gets it. Then those that got all of theirs
/// act, side by side; the others try again in the next round, before items that come after them.
///
/// - claim(i, claims) changes nothing and may read everything. It returns void or bool: false says
///   that the item has nothing to do and never will have, and it is done.
/// - act(i) reads and writes only what its places stand for. It returns void or Status.
///
/// 1. Rounds depend on the items alone, so the result is the same for any team and schedule.
/// 2. It is that of the plain loop `for (i = 0; i < n; ++i) if (claim(i)) act(i);` under three
///    conditions: the places of an item are always the same ones; claim reads only what these stand
///    for or what no act changes; what it once answers with false it always would (what is taken
///    stays taken). Otherwise an item may act, or be done, before a lower one that would have
///    changed its mind.
/// 3. Errors as in for_each: that of the lowest failing item, and what the items share is then in
///    between. Region::order must be empty; grain is for act; alone_below counts for nothing.
///
/// An item is claimed for at least once, some 35 ns a place, and as often as it comes in vain:
/// items that all want one place go one by one. Prefer to gather where that is possible
/// (docs/patterns/reservations.md).
/// Source: Blelloch, Fineman, Gibbons, Shun, Internally deterministic parallel algorithms can be
/// fast, PPoPP 2012.
template <class Claim, class Act>
[[nodiscard]] Result<ReservedRun> for_each_reserved(const Context& context, const Region& region,
                                                    std::size_t places, Claim&& claim, Act&& act) {
  using Answer = std::invoke_result_t<Claim&, std::size_t, Claims&>;
  static_assert(std::is_void_v<Answer> || std::is_convertible_v<Answer, bool>,
                "claim returns void or bool; an Error is for act to return");
  detail::require_shareable<Claim, std::size_t, Claims&>();
  detail::require_shareable<Act, std::size_t>();
  return detail::run_reserved(
      context, region, places,
      [&](std::size_t i, Claims& claims) {
        if constexpr (std::is_void_v<Answer>) {
          claim(i, claims);
          return true;
        } else {
          return static_cast<bool>(claim(i, claims));
        }
      },
      [&](std::size_t i) -> Status {
        if constexpr (std::is_void_v<std::invoke_result_t<Act&, std::size_t>>) {
          act(i);
          return {};
        } else {
          return act(i);
        }
      });
}

}  // namespace strake::parallel
