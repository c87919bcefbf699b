// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0120 says which lists one worker made before, and what of it was left out.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "strake/parallel/count_fill.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/slots.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::parallel {

/// Values by lots, those of a lot in the order of their items.
template <class T, std::size_t kLots>
struct Dealt {
  std::vector<T> values;
  std::array<std::size_t, kLots + 1> begin{};  ///< where each lot begins, and the end

  [[nodiscard]] std::span<const T> operator[](std::size_t lot) const {
    return std::span<const T>(values).subspan(begin[lot], begin[lot + 1] - begin[lot]);
  }
};

/// Deals items out to a fixed number of lots, all at once and by all workers: lines to layers,
/// hashes to buckets.
///
///     const auto layers = deal<const Line*, kLayers>(
///         context, "lines of layers", lines.size(),
///         [&](std::size_t i) { return layer_of(lines[i]); },
///         [&](std::size_t i) { return &lines[i]; });
///     ... (*layers)[layer] are the lines of a layer, in the order of `lines` ...
///
/// `lot_of(i)` is called twice and says the same both times: kLots leaves the item out. `value(i)`
/// is called once for each of the others. Runs of items are counted, then written where they belong
/// by the counts of those before them, so that the result is the same for any team. Errors as in
/// for_each.
template <class T, std::size_t kLots, class LotOf, class Value>
[[nodiscard]] Result<Dealt<T, kLots>> deal(const Context& context, std::string_view name,
                                           std::size_t n, LotOf&& lot_of, Value&& value) {
  detail::require_shareable<LotOf, std::size_t>();
  detail::require_shareable<Value, std::size_t>();
  /// Items that a worker takes at once.
  constexpr std::size_t kPerRun = 16384;
  using Counts = std::array<std::size_t, kLots + 1>;
  const Region runs{.name = name, .n = n / kPerRun + (n % kPerRun != 0 ? 1 : 0)};
  const auto last_of = [&](std::size_t run) { return std::min(n, (run + 1) * kPerRun); };
  Result<std::vector<Counts>> counts = transform(context, runs, [&](std::size_t run) {
    Counts of{};
    for (std::size_t i = run * kPerRun; i < last_of(run); ++i) ++of[lot_of(i)];
    return of;
  });
  if (!counts) return std::move(counts).error();
  // Lot by lot, run by run: where the items of each run go in each lot.
  Dealt<T, kLots> dealt;
  std::size_t at = 0;
  for (std::size_t lot = 0; lot < kLots; ++lot) {
    dealt.begin[lot] = at;
    for (Counts& of : *counts) at += std::exchange(of[lot], at);
  }
  dealt.begin[kLots] = at;
  Result<std::vector<T>> values = unset_slots<T>(at, context);
  if (!values) return std::move(values).error();
  dealt.values = std::move(*values);
  Status status = for_each(context, runs, [&](std::size_t run) {
    Counts next = (*counts)[run];
    for (std::size_t i = run * kPerRun; i < last_of(run); ++i)
      if (const std::size_t lot = lot_of(i); lot < kLots) dealt.values[next[lot]++] = value(i);
  });
  if (!status) return std::move(status).error();
  return dealt;
}

/// Lists the items that have each key, ascending: list k of the result is the numbers of the items
/// whose key is k. It is a sort by counting for many keys, by all workers: items are dealt out to
/// lots of neighbouring keys, each of which is counted out by itself.
///
///     const auto of_object = items_by_key(context, "lines by object", lines.size(), objects,
///                                         [&](std::size_t i) { return object_of(lines[i]); });
///     ... (*of_object)[o] are the numbers of the lines of object o ...
///
/// `key_of(i)` is below `keys`; it is called some times for an item, and says the same each time.
/// Fewer than 2^32 items. Errors as in for_each.
template <class KeyOf>
[[nodiscard]] Result<Packed<std::uint32_t>> items_by_key(const Context& context,
                                                         std::string_view name, std::size_t n,
                                                         std::size_t keys, KeyOf&& key_of) {
  constexpr std::size_t kLots = 64;
  const std::size_t per_lot = keys / kLots + 1;
  Result<Dealt<std::uint32_t, kLots>> lots = deal<std::uint32_t, kLots>(
      context, name, n, [&](std::size_t i) { return key_of(i) / per_lot; },
      [](std::size_t i) { return static_cast<std::uint32_t>(i); });
  if (!lots) return std::move(lots).error();
  Result<std::vector<std::size_t>> offsets = unset_slots<std::size_t>(keys + 1);
  if (!offsets) return std::move(offsets).error();
  Result<std::vector<std::uint32_t>> values = unset_slots<std::uint32_t>(n);
  if (!values) return std::move(values).error();
  Status status = for_each(context, {.name = name, .n = kLots}, [&](std::size_t lot) {
    const std::size_t begin = std::min(keys, lot * per_lot), end = std::min(keys, begin + per_lot);
    std::vector<std::size_t> next(end - begin);
    for (const std::uint32_t i : (*lots)[lot]) ++next[key_of(i) - begin];
    std::size_t at = lots->begin[lot];
    for (std::size_t key = begin; key < end; ++key) {
      (*offsets)[key] = at;
      at += std::exchange(next[key - begin], at);
    }
    for (const std::uint32_t i : (*lots)[lot]) (*values)[next[key_of(i) - begin]++] = i;
  });
  if (!status) return std::move(status).error();
  offsets->back() = n;
  return Packed<std::uint32_t>{std::move(*offsets), std::move(*values)};
}

}  // namespace strake::parallel
