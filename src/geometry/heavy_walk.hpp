// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "geometry/heavy_rounds.hpp"
#include "geometry/near_walk.hpp"

namespace strake::geometry {

/// A NearWalk that asks a team for help once it has turned out to be heavy.
///
/// `begin()` makes the state of a piece from what is known so far: `reach`, a square that may
/// shrink, `work`, and operator()(NearTriangles) as NearWalk's visitor. `take(state)` gets the
/// states in the order of a single walk and tells whether to go on. Where the team was stopped some
/// are missing.
template <class Begin, class Take>
void heavy_near_walk(const PartView& a, const PartView& b, double near_enough, PairWork& work,
                     const Begin& begin, const Take& take) {
  using State = decltype(begin());
  const auto charge = [&](State& state) {
    work += state.work;
    return take(state);
  };
  State first = begin();
  NearWalk walk(a, b, first.work, near_enough);
  walk.start(first.reach);
  const bool heavy = walk.run(first.reach, first, kWalkedAlone) == WalkEnd::left_off;
  const double reach = first.reach;
  if (!charge(first) || !heavy) return;
  (void)run_in_rounds(
      work.context(), walk.rest(reach, kWalkPieces), [&](std::size_t /*i*/) { return begin(); },
      [&](State& state, const NearWalk::Entry& entry) {
        NearWalk piece(a, b, state.work, near_enough);
        piece.start(entry);
        piece.run(state.reach, state);
      },
      charge);
}

}  // namespace strake::geometry
