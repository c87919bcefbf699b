// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "clash/cases.hpp"
#include "clash/narrow_part.hpp"
#include "clash/parts.hpp"

namespace strake::clash {

/// One case of a pair of parts on its way through the engine.
struct Candidate {
  FirstLook look;
  NarrowCost cost;
  KnownBefore known;
  bool done = false;
  bool too_large = false;
  bool in_open = false;  ///< one part lies within the other, which is open: see mark_enclosed()
  bool too_near_to_tell = false;  ///< whether it has one place or several
};

/// Has a candidate judged, with a team's help where it is heavy, and notes what it cost:
/// `judge(NarrowWork&)` gives the answer.
template <class Judge>
auto charged(Candidate& candidate, const parallel::Context& team, Judge&& judge) {
  NarrowWork work;
  work.pair.team = &team;
  auto answer = judge(work);
  candidate.cost.add(work);
  return answer;
}

/// The pairs that went to the detailed stage, and what it found.
struct Judged {
  const PartList& list;
  std::span<const geometry::IndexPair> pairs;
  const Cases& cases;
  std::span<const Candidate> candidates;  ///< one per case

  [[nodiscard]] const Candidate& of(std::size_t pair) const { return candidates[cases.of[pair]]; }
  [[nodiscard]] const PartRef& a(std::size_t pair) const { return list.parts[pairs[pair].first]; }
  [[nodiscard]] const PartRef& b(std::size_t pair) const { return list.parts[pairs[pair].second]; }
};

}  // namespace strake::clash
