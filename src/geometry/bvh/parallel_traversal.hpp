// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "strake/parallel/for_each.hpp"
#include "strake/parallel/region.hpp"

// Thresholds from which work on a part is shared, and heavy traversals in parallel rounds.

namespace strake::geometry {

/// From this many triangles, vertices or edges on, work on one part is worth a team; below it none
/// is started. Between 16'384 and 262'144 ships show no difference (decision 0073).
inline constexpr std::size_t kParallelThreshold = std::size_t{1} << 16U;
/// Number of items of such a loop that a worker takes at once. Between 1024 and 16'384 no
/// difference can be seen (decision 0073).
inline constexpr std::size_t kParallelGrain = std::size_t{1} << 12U;

/// Returns the region of a loop over the triangles, vertices or edges of one part.
[[nodiscard]] inline parallel::Region over_part(std::string_view name, std::size_t n) {
  return {.name = name, .n = n, .grain = kParallelGrain, .alone_below = kParallelThreshold};
}

/// Number of node pairs that a traversal visits sequentially before it counts as heavy: about a
/// millisecond.
inline constexpr std::uint64_t kSequentialNodePairs = std::uint64_t{1} << 15U;
/// Number of subtasks that the rest of a heavy traversal is split into. Between 64 and 1024 no
/// difference can be seen (decision 0073).
inline constexpr std::size_t kTraversalPieces = 256;
/// Minimum number of subtasks in every round but the last: enough to share among a team. Between 2
/// and 32 no difference can be seen (decision 0073).
inline constexpr std::size_t kSmallestRound = 8;

/// Runs the subtasks of a heavy traversal with a team, in rounds, each twice as large as the one
/// before: late ones start from what early ones found, and the decisive contact is mostly found
/// soon.
///
/// `begin(i)` makes the state of the i-th piece of a round, `run(state, piece)` is called for all
/// of a round at once, `take(state)` in the order of the pieces; it returns whether to go on.
/// `limit(done)` limits the next round where the results so far show that fewer pieces suffice.
/// Rounds depend on the number of pieces and on these results alone, and so do the states. Errors:
/// cancelled.
template <class Piece, class Begin, class Run, class Take, class Most>
Status run_in_doubling_rounds(const parallel::Context& context, const std::vector<Piece>& pieces,
                              const Begin& begin, const Run& run, const Take& take,
                              const Most& limit) {
  std::size_t round = kSmallestRound;
  for (std::size_t done = 0; done < pieces.size(); done += round, round *= 2) {
    round = std::min({round, pieces.size() - done, std::max(kSmallestRound, limit(done))});
    std::vector<decltype(begin(done))> states;
    states.reserve(round);
    for (std::size_t i = 0; i < round; ++i) states.push_back(begin(i));
    const Status status =
        parallel::for_each(context, {.name = "pieces of a pair", .n = round},
                           [&](std::size_t i) { run(states[i], pieces[done + i]); });
    if (!status) return status;
    for (auto& state : states)
      if (!take(state)) return {};
  }
  return {};
}

template <class Piece, class Begin, class Run, class Take>
Status run_in_doubling_rounds(const parallel::Context& context, const std::vector<Piece>& pieces,
                              const Begin& begin, const Run& run, const Take& take) {
  return run_in_doubling_rounds(context, pieces, begin, run, take,
                                [&](std::size_t /*done*/) { return pieces.size(); });
}

}  // namespace strake::geometry
