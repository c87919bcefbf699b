// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/geometry/part.hpp"

namespace strake::geometry {

/// What the boxes of two parts say about how the parts meet.
struct FlushContact {
  /// A coordinate plane lies between the two (or holds the contact): their interiors are disjoint
  /// and no sheet crosses another.
  bool separated = false;
  bool touching = false;  ///< a common point was found, in that plane
  Vec3d point;            ///< that point, grid units relative to a's origin
};

/// Most contacts of a real model are flush with a coordinate plane: a deck and what stands on it.
/// They are decided exactly from the triangles in that plane alone, without a tree.
///
/// `separated` without `touching` says that the parts do not meet in the plane or that there are
/// too many triangles in it to try all pairs: ask closest().
[[nodiscard]] FlushContact flush_contact(const PlacedPart& a, const PlacedPart& b);

}  // namespace strake::geometry
