// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "strake/geometry/part_pair.hpp"

namespace strake::geometry {

/// What two parts have near each other across a slab.
struct NearAcross {
  std::optional<Closest> near;  ///< as any_within() gives it
  bool asked = false;           ///< false: it was too much to look at, and nothing is known
};

/// any_within() of small parts that lie face to face, without trees. `normal`, a unit vector from b
/// to a, is across the widest slab between them (part_frame.hpp), which may be a little less than
/// nothing: only triangles that come within `distance` grid units of its other end are looked at,
/// those that lie at its ends first.
[[nodiscard]] NearAcross near_across(const PlacedPart& a, const PlacedPart& b, const Vec3d& normal,
                                     double distance, PairWork& work);

}  // namespace strake::geometry
