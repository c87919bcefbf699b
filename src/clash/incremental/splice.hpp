// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "clash/incremental/object_map.hpp"
#include "strake/clash/incremental.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/for_each.hpp"

/// Long lists of pairs that follow a change where they are: only what lies between the first and
/// the last item that comes or goes is moved.
namespace strake::clash {

/// Some neighbouring items of a list: [first, last).
struct ItemRun {
  std::size_t first = 0, last = 0;
};

/// Returns ascending numbers as runs of neighbours.
[[nodiscard]] inline std::vector<ItemRun> runs_of(std::span<const std::size_t> numbers) {
  std::vector<ItemRun> runs;
  for (const std::size_t n : numbers) {
    if (runs.empty() || runs.back().last != n)
      runs.push_back({n, n + 1});
    else
      ++runs.back().last;
  }
  return runs;
}

/// Returns all of so many numbers as runs of at most so many.
[[nodiscard]] inline std::vector<ItemRun> runs_of_length(std::size_t numbers,
                                                         std::size_t max_length) {
  std::vector<ItemRun> runs;
  for (std::size_t first = 0; first < numbers; first += max_length)
    runs.push_back({first, std::min(numbers, first + max_length)});
  return runs;
}

/// Returns the items, by (a, b), whose a is in one of some blocks of objects: a run for each.
template <class T>
[[nodiscard]] std::vector<ItemRun> items_of(const std::vector<T>& list,
                                            const std::vector<bool>& blocks) {
  const auto first_from = [&](std::size_t object) {
    return static_cast<std::size_t>(
        std::ranges::lower_bound(list, object, {}, [](const T& item) { return index(item.a); }) -
        list.begin());
  };
  std::vector<ItemRun> runs;
  for (std::size_t block = 0; block < blocks.size(); ++block)
    if (blocks[block])
      runs.push_back({first_from(block * PartnerBlocks::kObjects),
                      first_from((block + 1) * PartnerBlocks::kObjects)});
  return runs;
}

/// Returns the first item that is in no run and not before `item`, or the end of the list. The
/// items outside the runs are ascending.
template <class T, class Before>
[[nodiscard]] std::size_t place_among(const std::vector<T>& list, std::span<const ItemRun> runs,
                                      const T& item, const Before& before) {
  // Returns i, or the end of the run that it lies in.
  const auto beyond_run = [&](std::size_t i) {
    const auto run = std::ranges::upper_bound(runs, i, {}, &ItemRun::last);
    return run != runs.end() && run->first <= i ? run->last : i;
  };
  std::size_t low = 0, high = list.size();
  while (low < high) {
    const std::size_t middle = beyond_run(low + (high - low) / 2);
    if (middle >= high)
      high = low + (high - low) / 2;
    else if (before(list[middle], item))
      low = middle + 1;
    else
      high = low + (high - low) / 2;
  }
  return beyond_run(low);
}

/// Removes the runs from a list and puts ascending items in their places, which it returns.
template <class T, class Before>
std::vector<std::size_t> splice(std::vector<T>& list, std::span<const ItemRun> runs,
                                const std::vector<T>& added, const Before& before) {
  using Shift = std::ptrdiff_t;
  struct Segment {
    std::size_t first = 0, last = 0;
    Shift shift = 0;
  };
  const std::size_t size = list.size();
  std::vector<Segment> segments;
  std::vector<std::size_t> places;  // where the added items go
  std::size_t at = 0, run = 0;
  Shift shift = 0;
  const auto go_to = [&](std::size_t next) {
    if (next > at) segments.push_back({at, next, shift});
    at = next;
  };
  const auto drop_until = [&](std::size_t limit) {
    for (; run < runs.size() && runs[run].first < limit; ++run) {
      go_to(runs[run].first);
      at = runs[run].last;
      shift -= static_cast<Shift>(runs[run].last - runs[run].first);
    }
  };
  for (const T& item : added) {
    const std::size_t place = place_among(list, runs, item, before);
    drop_until(place);
    go_to(place);
    places.push_back(static_cast<std::size_t>(static_cast<Shift>(place) + shift));
    ++shift;
  }
  drop_until(size);
  go_to(size);
  const auto end = static_cast<std::size_t>(static_cast<Shift>(size) + shift);
  list.reserve(end);
  list.resize(std::max(size, end));
  const auto item = [&](std::size_t i) { return list.begin() + static_cast<Shift>(i); };
  // What moves down goes from the front, then what moves up from the back: neither is written over
  // before it is read.
  for (const Segment& s : segments)
    if (s.shift < 0) std::move(item(s.first), item(s.last), item(s.first) + s.shift);
  for (auto s = segments.rbegin(); s != segments.rend(); ++s)
    if (s->shift > 0) std::move_backward(item(s->first), item(s->last), item(s->last) + s->shift);
  for (std::size_t i = 0; i < added.size(); ++i) list[places[i]] = added[i];
  list.resize(end);
  return places;
}

/// Brings a list of pairs of objects, T::a and T::b, up to date: calls `gone(item)` for each that
/// has a changed object, in their order and before anything is changed, removes them, gives the
/// others the new numbers, and puts in `added`; returns where these are now. `blocks` says of which
/// PartnerBlocks any item has a changed object; null: it is not known. Errors: cancelled.
template <class T, class Gone>
[[nodiscard]] Result<std::vector<std::size_t>> splice_changes(
    std::vector<T>& list, const std::vector<T>& added, const ObjectMap& map,
    const parallel::Context& context, const Gone& gone, const std::vector<bool>* blocks = nullptr) {
  /// Only shares the work out: between 4096 and 65'536 no difference can be seen (decision 0073).
  constexpr std::size_t kGrain = 16384;
  const std::vector<ItemRun> visited =
      blocks == nullptr ? runs_of_length(list.size(), kGrain) : items_of(list, *blocks);
  const auto dead = parallel::collect<std::size_t>(
      context, {.name = "pairs of changed objects", .n = visited.size()},
      [&](std::size_t r, std::vector<std::size_t>& out) {
        for (std::size_t i = visited[r].first; i < visited[r].last; ++i)
          if (map.now[index(list[i].a)] == model::kNoObject ||
              map.now[index(list[i].b)] == model::kNoObject)
            out.push_back(i);
      });
  if (!dead) return dead.error();
  for (const std::size_t i : *dead) gone(list[i]);
  if (map.renumbered) {
    const Status done =
        parallel::for_each(context, {.name = "pairs renumbered", .n = list.size(), .grain = kGrain},
                           [&](std::size_t i) {
                             list[i].a = model::ObjectId{map.now[index(list[i].a)]};
                             list[i].b = model::ObjectId{map.now[index(list[i].b)]};
                           });
    if (!done) return done.error();
  }
  return splice(list, std::span<const ItemRun>(runs_of(*dead)), added,
                [](const T& x, const T& y) { return std::tie(x.a, x.b) < std::tie(y.a, y.b); });
}

}  // namespace strake::clash
