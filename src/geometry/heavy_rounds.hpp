// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "strake/parallel/for_each.hpp"

namespace strake::geometry {

/// Node pairs that a walk takes alone before it counts as heavy: about a millisecond.
inline constexpr std::uint64_t kWalkedAlone = std::uint64_t{1} << 15U;
/// Pieces that what is left of a heavy walk is cut into.
inline constexpr std::size_t kWalkPieces = 256;
/// Fewest pieces of a round, the last one's apart: enough to share among a team.
inline constexpr std::size_t kLeastRound = 8;

/// Runs the pieces of a heavy walk with a team's help, in rounds, each twice as large as the one
/// before: late ones start from what early ones found, and what decides is mostly found soon.
///
/// `begin(i)` makes the state of the i-th piece of a round, `run(state, piece)` is called for all
/// of a round at once, `take(state)` in the order of the pieces; it tells whether to go on.
/// `most(done)` limits the next round where what was found tells that less will do. Rounds depend
/// on the number of pieces and on these answers alone, and so do the states. Errors: cancelled.
template <class Piece, class Begin, class Run, class Take, class Most>
Status run_in_rounds(const parallel::Context& context, const std::vector<Piece>& pieces,
                     const Begin& begin, const Run& run, const Take& take, const Most& most) {
  std::size_t round = kLeastRound;
  for (std::size_t done = 0; done < pieces.size(); done += round, round *= 2) {
    round = std::min({round, pieces.size() - done, std::max(kLeastRound, most(done))});
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
Status run_in_rounds(const parallel::Context& context, const std::vector<Piece>& pieces,
                     const Begin& begin, const Run& run, const Take& take) {
  return run_in_rounds(context, pieces, begin, run, take,
                       [&](std::size_t /*done*/) { return pieces.size(); });
}

}  // namespace strake::geometry
