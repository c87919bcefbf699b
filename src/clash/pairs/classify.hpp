// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "strake/clash/clash.hpp"

namespace strake::clash {

/// The thresholds of one pair of parts, grid units; `overlap` is t_o', capped by thickness.
struct Thresholds {
  double overlap = 0, gap = 0, clearance = 0;
  /// Parts no farther apart and no deeper than this count as touching: 0 but for coarse numbers.
  double step = 0;
  /// The part of the sag by which closing seams of the two meshes may have moved them.
  double weld = 0;
};

/// The signed separation of a pair, grid units: the certified bracket of the geometry on the grid,
/// and how far that geometry may lie from the true surfaces.
struct SignedSeparation {
  double d = 0;
  double lower = 0, upper = 0;
  double sag = 0;
  /// How far the geometry on the grid may lie from what the source states: what the snap moved, and
  /// the step of coarse numbers.
  double moved = 0;
  bool interiors_meet = false;  ///< decided exactly: d < 0, however small
  bool depth_complete = true;   ///< no work limit ended a search for the depth
};

struct Classification {
  Class cls = Class::no_hit;
  std::uint16_t flags = 0;
  Class severest = Class::no_hit;  ///< the severest that the bracket, sag included, allows

  friend bool operator==(const Classification&, const Classification&) = default;
};

/// Grid units: the widest bracket about a threshold for which the grid and the arithmetic alone may
/// account. Two bodies, each with its place and its vertices snapped, are off by less than 3.5
/// either way.
inline constexpr double kBorderlineWidth = 8;

/// Grid units: how far a weld of two bodies moves them against each other at most, if the snap
/// alone took their corners off the edges they are on: 2 * sqrt(3). What is more was apart in the
/// source.
inline constexpr double kMaxWeldBySnap = 3.4642;

/// Returns the class of a bracket. A bracket about a threshold and no wider than kBorderlineWidth
/// gives the severer class and kBorderline; a wider one the class of d and kUncertain. A tolerance
/// of 0 is compared with the geometry on the grid itself, whatever the snap moved, where no sag
/// lies between the two. A weld for which the snap may account counts as what the snap moved and
/// widens nothing here; where a larger one leaves open whether there is a result at all, that is
/// not NO_HIT.
[[nodiscard]] Classification classify(const SignedSeparation& s, const Thresholds& t);

}  // namespace strake::clash
