// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "strake/clash/clash.hpp"

namespace strake::clash {

/// Thresholds of one pair of parts, grid units; `overlap` is t_o', capped by thickness.
struct Thresholds {
  double overlap = 0, gap = 0, clearance = 0;
};

/// Signed separation of a pair, grid units: the certified bracket of the geometry on the grid, and
/// how far that geometry may lie from the true surfaces.
struct Separation {
  double d = 0;
  double lower = 0, upper = 0;
  double sag = 0;
  bool interiors_meet = false;  ///< decided exactly: d < 0, however small
};

struct Judgement {
  Class cls = Class::no_hit;
  std::uint16_t flags = 0;
  Class severest = Class::no_hit;  ///< that the bracket, sag included, allows

  friend bool operator==(const Judgement&, const Judgement&) = default;
};

/// The class of a bracket. A bracket about a threshold and no wider than a grid unit gives the
/// severer class and kBorderline; a wider one the class of d and kUncertain.
[[nodiscard]] Judgement judge(const Separation& s, const Thresholds& t);

}  // namespace strake::clash
