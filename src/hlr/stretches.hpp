// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hlr/occlusion.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::hlr {

/// The part of an edge that is still to be decided: everything outside is hidden on both sides.
class OpenRange {
 public:
  OpenRange() = default;
  OpenRange(const Param& lo, const Param& hi) : lo_(lo), hi_(hi) {}

  [[nodiscard]] const Param& lo() const { return lo_; }
  [[nodiscard]] const Param& hi() const { return hi_; }
  [[nodiscard]] bool empty() const { return !less(lo_, hi_); }

  /// Takes away what a hit at either end hides on both sides; true when that changed anything.
  bool shrink(const Hit& hit) {
    if (hit.sides != kBothSides) return false;
    bool changed = false;
    if (!less(lo_, hit.lo) && less(lo_, hit.hi)) {
      lo_ = hit.hi;
      changed = true;
    }
    if (!less(hit.hi, hi_) && less(hit.lo, hi_)) {
      hi_ = hit.lo;
      changed = true;
    }
    return changed;
  }
  /// The same with the newest hit and then with those before it, until nothing changes.
  bool shrink_all(std::span<const Hit> hits);

 private:
  Param lo_ = Param::zero(), hi_ = Param::one();
};

/// A stretch of an edge in one state.
struct Stretch {
  Param lo, hi;
  State state = State::visible;
};

/// Turns hits into the states of docs/hlr.md along [lo, hi]: neighbours differ, none is empty.
class StretchMaker {
 public:
  void run(std::span<const Hit> hits, const Param& lo, const Param& hi, std::vector<Stretch>& out);

 private:
  struct Event {
    const Param* at = nullptr;
    std::uint8_t sides = 0;
    bool self = false, begins = false;
  };
  void count(const Event& event);
  [[nodiscard]] State state() const;

  std::vector<Event> events_;
  std::uint32_t self_[2] = {0, 0}, all_[2] = {0, 0};
};

}  // namespace strake::hlr
