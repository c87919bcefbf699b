// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "strake/parallel/for_each.hpp"
#include "strake/parallel/region.hpp"

namespace strake::geometry {

/// From as many triangles, vertices or edges on, working on one part is worth a team. Below it
/// nothing is spent on asking for one.
inline constexpr std::size_t kParallelThreshold = std::size_t{1} << 16U;
/// Items of such a loop that a worker takes at once.
inline constexpr std::size_t kParallelGrain = std::size_t{1} << 12U;

/// A loop over the triangles, vertices or edges of one part.
[[nodiscard]] inline parallel::Region over_part(std::string_view name, std::size_t n) {
  return {.name = name, .n = n, .grain = kParallelGrain, .alone_below = kParallelThreshold};
}

/// Node pairs that a walk takes alone before it counts as heavy: about a millisecond.
inline constexpr std::uint64_t kSequentialNodePairs = std::uint64_t{1} << 15U;
/// Pieces that what is left of a heavy walk is cut into.
inline constexpr std::size_t kTraversalPieces = 256;
/// Fewest pieces of a round, the last one's apart: enough to share among a team.
inline constexpr std::size_t kSmallestRound = 8;

/// Runs the pieces of a heavy walk with a team's help, in rounds, each twice as large as the one
/// before: late ones start from what early ones found, and what decides is mostly found soon.
///
/// `begin(i)` makes the state of the i-th piece of a round, `run(state, piece)` is called for all
/// of a round at once, `take(state)` in the order of the pieces; it tells whether to go on.
/// `most(done)` limits the next round where what was found tells that less will do. Rounds depend
/// on the number of pieces and on these answers alone, and so do the states. Errors: cancelled.
template <class Piece, class Begin, class Run, class Take, class Most>
Status run_in_doubling_rounds(const parallel::Context& context, const std::vector<Piece>& pieces,
                              const Begin& begin, const Run& run, const Take& take,
                              const Most& most) {
  std::size_t round = kSmallestRound;
  for (std::size_t done = 0; done < pieces.size(); done += round, round *= 2) {
    round = std::min({round, pieces.size() - done, std::max(kSmallestRound, most(done))});
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
