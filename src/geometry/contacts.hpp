// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/pair_view.hpp"
#include "geometry/sectors.hpp"
#include "geometry/shell_set.hpp"
#include "strake/geometry/part_pair.hpp"

namespace strake::geometry {

/// What the contacts of two surfaces say of how the parts meet.
struct Contacts {
  Overlap overlap;
  bool boundaries_meet = false;
  std::uint32_t triangle_a = kNoFace, triangle_b = kNoFace;  ///< where, and at which point
  Vec3d point;
  bool flush = false;           ///< some triangles lie on each other
  bool separated = false;       ///< a plane decided: neither part has a point inside the other
  ShellSet linear_a, linear_b;  ///< shells with contact along a segment or an area

  /// Nothing that is still to come can change the answer.
  [[nodiscard]] bool decided() const { return separated || overlap.complete(); }
};

/// Boxes of two nodes or parts that have a point in common, in the pair's coordinates.
[[nodiscard]] inline bool boxes_meet(const PartView& a, const Box3i& box_a, const PartView& b,
                                     const Box3i& box_b) {
  return a.box(box_a).meets(b.box(box_b));
}

/// Walks over the contacts of two planted parts until they have decided or there are no more. What
/// is heavy is shared with the team of `work`.
[[nodiscard]] Contacts find_contacts(const PartView& a, const PartView& b, PairWork& work);

}  // namespace strake::geometry
