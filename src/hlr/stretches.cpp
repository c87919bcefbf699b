// SPDX-License-Identifier: Apache-2.0
#include "hlr/stretches.hpp"

#include <algorithm>

namespace strake::hlr {
namespace {

// With more hits than this, looking back at them all for each new one would cost more than it
// spares.
constexpr std::size_t kLookBack = 48;

void append(std::vector<Stretch>& out, std::size_t first, const Param& lo, const Param& hi,
            State state) {
  if (out.size() > first && out.back().state == state)
    out.back().hi = hi;
  else
    out.push_back({lo, hi, state});
}

}  // namespace

bool OpenRange::shrink_all(std::span<const Hit> hits) {
  if (hits.empty() || !shrink(hits.back())) return false;
  if (hits.size() > kLookBack) hits = hits.last(kLookBack);
  for (bool again = true; again && !empty();) {
    again = false;
    for (const Hit& hit : hits) again = shrink(hit) || again;
  }
  return true;
}

void StretchMaker::count(const Event& event) {
  for (unsigned side = 0; side < 2; ++side) {
    if ((event.sides >> side & 1U) == 0) continue;
    if (event.begins) {
      ++all_[side];
      if (event.self) ++self_[side];
    } else {
      --all_[side];
      if (event.self) --self_[side];
    }
  }
}

State StretchMaker::state() const {
  if (self_[0] > 0 && self_[1] > 0) return State::hidden_by_self;
  return all_[0] > 0 && all_[1] > 0 ? State::hidden_by_other : State::visible;
}

void StretchMaker::run(std::span<const Hit> hits, const Param& lo, const Param& hi,
                       std::vector<Stretch>& out) {
  const std::size_t first = out.size();
  bool hidden = false;  // all of it, by others at least
  for (const Hit& hit : hits) {
    if (hit.sides != kBothSides || less(lo, hit.lo) || less(hit.hi, hi)) continue;
    if (hit.self) return append(out, first, lo, hi, State::hidden_by_self);
    hidden = true;
  }
  for (unsigned side = 0; side < 2; ++side) {
    self_[side] = 0;
    all_[side] = hidden ? 1 : 0;
  }
  events_.clear();
  for (const Hit& hit : hits) {
    if (hidden && !hit.self) continue;  // what else hides it makes no difference
    events_.push_back({&hit.lo, hit.sides, hit.self, true});
    events_.push_back({&hit.hi, hit.sides, hit.self, false});
  }
  // Ends of one parameter may come in any order: between them lies nothing.
  std::sort(events_.begin(), events_.end(),
            [](const Event& x, const Event& y) { return less(*x.at, *y.at); });
  const Param* from = &lo;
  for (const Event& event : events_) {
    if (!less(*event.at, hi)) break;
    if (less(*from, *event.at)) {
      append(out, first, *from, *event.at, state());
      from = event.at;
    }
    count(event);
  }
  append(out, first, *from, hi, state());
}

}  // namespace strake::hlr
