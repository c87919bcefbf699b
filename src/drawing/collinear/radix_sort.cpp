// SPDX-License-Identifier: Apache-2.0
#include "drawing/collinear/radix_sort.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <span>
#include <utility>

#include "strake/parallel/for_each.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/slots.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::drawing {

namespace {

constexpr unsigned kDigitBits = 11;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
// Only shares the work out: between 65'536 and 1'048'576 no difference can be seen (decision 0073).
constexpr std::size_t kPiece = 262144;
using Counts = std::array<std::uint32_t, kDigits>;

std::size_t digit(std::uint64_t key, unsigned shift) { return (key >> shift) & (kDigits - 1); }

/// Returns the items of one block.
template <class T>
std::span<T> piece_of(std::span<T> items, std::size_t number) {
  const std::size_t first = number * kPiece;
  return items.subspan(first, std::min(kPiece, items.size() - first));
}

/// One pass: distributes the items of `from` to `to` by one digit of their keys.
Status deal(std::span<const KeyedItem> from, std::span<KeyedItem> to, unsigned shift,
            const parallel::Context& context) {
  const std::size_t pieces = (from.size() + kPiece - 1) / kPiece;
  auto counts =
      parallel::transform(context, {.name = "count digits", .n = pieces}, [&](std::size_t number) {
        Counts of{};
        for (const KeyedItem& k : piece_of(from, number)) ++of[digit(k.key, shift)];
        return of;
      });
  if (!counts) return counts.error();
  std::uint32_t at = 0;
  for (std::size_t d = 0; d < kDigits; ++d)
    for (Counts& of : *counts) at += std::exchange(of[d], at);
  return parallel::for_each(context, {.name = "deal digits", .n = pieces}, [&](std::size_t number) {
    Counts& next = (*counts)[number];
    for (const KeyedItem& k : piece_of(from, number)) to[next[digit(k.key, shift)]++] = k;
  });
}

}  // namespace

Status radix_sort(std::vector<KeyedItem>& items, const parallel::Context& context) {
  const auto highest = parallel::reduce(
      context, {.name = "highest key", .n = items.size(), .grain = kPiece}, std::uint64_t{0},
      [&](std::uint64_t& largest, std::size_t i) { largest = std::max(largest, items[i].key); },
      [](std::uint64_t& into, const std::uint64_t& largest) { into = std::max(into, largest); });
  if (!highest) return highest.error();
  const auto bits = static_cast<unsigned>(std::bit_width(*highest));
  if (bits == 0) return {};
  auto made = parallel::unset_slots<KeyedItem>(items.size());
  if (!made) return made.error();
  std::vector<KeyedItem> other = std::move(*made);
  for (unsigned shift = 0; shift < bits; shift += kDigitBits) {
    if (const Status status = deal(items, other, shift, context); !status) return status;
    items.swap(other);
  }
  return {};
}

}  // namespace strake::drawing
