// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "geometry/heavy_rounds.hpp"
#include "geometry/near_walk.hpp"

namespace strake::geometry {

/// Triangles of two parts up to which they are turned after walked_before_turning() node pairs; of
/// more it is first asked whether flat faces settle it.
inline constexpr std::size_t kTurnedEarly = 2048;

/// Node pairs, of up to 16 pairs of triangles each, that take about as long as turning the parts.
[[nodiscard]] inline std::uint64_t walked_before_turning(const PartView& a, const PartView& b) {
  return 32 + (a.part().triangles.size() + b.part().triangles.size()) / 4;
}

/// Node pairs after which flat faces of needles may be why a walk takes so long.
[[nodiscard]] inline std::uint64_t walked_before_flat(const PartView& a, const PartView& b) {
  return 512 + (a.part().triangles.size() + b.part().triangles.size()) / 4;
}

/// A NearWalk that asks a team for help once it has turned out to be heavy. After
/// walked_before_turning() or walked_before_flat() node pairs it begins anew in a frame along the
/// parts' needles, if there are such.
///
/// `begin()` makes the state of a piece from what is known so far: `reach`, a square that may
/// shrink, `work`, and operator()(NearTriangles) as NearWalk's visitor. `take(state)` gets the
/// states in the order of a single walk and tells whether to go on. Where the team was stopped some
/// are missing. `settled(state)` is asked while the walk is still alone, after walked_before_flat()
/// node pairs and then each time that the number has grown fourfold: true ends the walk. `most`:
/// see run_in_rounds().
template <class Begin, class Take, class Settled, class Most>
void heavy_near_walk(const PartView& a, const PartView& b, double near_enough, PairWork& work,
                     const Begin& begin, const Take& take, const Settled& settled,
                     const Most& most) {
  using State = decltype(begin());
  const auto charge = [&](State& state) {
    work += state.work;
    return take(state);
  };
  std::optional<State> first(begin());
  std::optional<AlignedParts> aligned;
  std::optional<NearWalk> walk(std::in_place, a, b, first->work, near_enough);
  walk->start(first->reach);
  std::uint64_t walked = 0;
  const auto turn = [&] {
    aligned = aligned_parts(a, b, work.context());
    if (!aligned) return;
    // Once more from the start: little is lost.
    work += first->work;
    first.emplace(begin());
    walk.emplace(a, b, first->work, near_enough, &*aligned);
    walk->start(first->reach);
  };
  bool heavy = true;
  const bool early = a.part().triangles.size() + b.part().triangles.size() <= kTurnedEarly;
  if (early) {
    heavy = walk->run(first->reach, *first, walked_before_turning(a, b)) == WalkEnd::left_off;
    if (heavy) turn();
  }
  for (std::uint64_t pause = walked_before_flat(a, b); heavy && walked < kWalkedAlone; pause *= 4) {
    const std::uint64_t until = std::min(pause, kWalkedAlone);
    heavy =
        walk->run(first->reach, *first, until - walked) == WalkEnd::left_off && !settled(*first);
    if (heavy && walked == 0 && !early) turn();
    walked = until;
  }
  const double reach = first->reach;
  if (!charge(*first) || !heavy) return;
  const AlignedParts* const parts = aligned ? &*aligned : nullptr;
  (void)run_in_rounds(
      work.context(), walk->rest(reach, kWalkPieces), [&](std::size_t /*i*/) { return begin(); },
      [&](State& state, const NearWalk::Entry& entry) {
        NearWalk piece(a, b, state.work, near_enough, parts);
        piece.start(entry);
        piece.run(state.reach, state);
      },
      charge, most);
}

template <class Begin, class Take, class Settled>
void heavy_near_walk(const PartView& a, const PartView& b, double near_enough, PairWork& work,
                     const Begin& begin, const Take& take, const Settled& settled) {
  heavy_near_walk(a, b, near_enough, work, begin, take, settled,
                  [](std::size_t /*done*/) { return kWalkPieces; });
}

}  // namespace strake::geometry
