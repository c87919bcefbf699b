// SPDX-License-Identifier: Apache-2.0
// Dealing the lines of a view out to layers, by all workers.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/slots.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::drawing {

/// Lines by lots, each in the order of the drawing.
template <std::size_t kLots>
struct DealtLines {
  std::vector<const Line*> lines;
  std::array<std::size_t, kLots + 1> begin{};

  [[nodiscard]] std::span<const Line* const> operator[](std::size_t lot) const {
    return std::span<const Line* const>(lines).subspan(begin[lot], begin[lot + 1] - begin[lot]);
  }
};

/// Deals lines out to lots: `lot_of(line)` is the number of its lot, or kLots where it is in none.
/// All lots are dealt out at once, as lines are a hundred bytes each and there are many lots. The
/// lines must outlive the result. Errors: cancelled, out of memory.
template <std::size_t kLots, class LotOf>
[[nodiscard]] Result<DealtLines<kLots>> deal_lines(std::span<const Line> lines,
                                                   const LotOf& lot_of,
                                                   const parallel::Context& context) {
  constexpr std::size_t kPerRun = 16384;
  using Counts = std::array<std::size_t, kLots + 1>;
  const parallel::Region runs{.name = "lines of layers",
                              .n = (lines.size() + kPerRun - 1) / kPerRun};
  const auto run = [&](std::size_t r) {
    return lines.subspan(r * kPerRun, std::min(kPerRun, lines.size() - r * kPerRun));
  };
  Result<std::vector<Counts>> counts = parallel::transform(context, runs, [&](std::size_t r) {
    Counts of{};
    for (const Line& line : run(r)) ++of[lot_of(line)];
    return of;
  });
  if (!counts) return counts.error();
  // Lot by lot, run by run: where the lines of each run go in each lot.
  DealtLines<kLots> dealt;
  std::size_t at = 0;
  for (std::size_t lot = 0; lot < kLots; ++lot) {
    dealt.begin[lot] = at;
    for (Counts& of : *counts) at += std::exchange(of[lot], at);
  }
  dealt.begin[kLots] = at;
  auto slots = parallel::unset_slots<const Line*>(at);
  if (!slots) return slots.error();
  dealt.lines = std::move(*slots);
  const Status status = parallel::for_each(context, runs, [&](std::size_t r) {
    Counts next = (*counts)[r];
    for (const Line& line : run(r))
      if (const std::size_t lot = lot_of(line); lot < kLots) dealt.lines[next[lot]++] = &line;
  });
  if (!status) return status.error();
  return dealt;
}

}  // namespace strake::drawing
