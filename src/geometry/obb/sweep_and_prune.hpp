// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/bvh/pair_local_part.hpp"
#include "geometry/obb/rotated_part.hpp"
#include "strake/geometry/vec.hpp"

// Sweep and prune over the triangles of two parts.

namespace strake::geometry {

/// Returns the axis along which boxes are shortest relative to the swept range. `lengths`: of one
/// box, or the sums of several.
[[nodiscard]] inline int sweep_axis(const Vec3d& lengths, const Box3d& within) {
  int best = 0;
  for (int k = 1; k < 3; ++k)
    if (lengths[k] * (within.hi[best] - within.lo[best]) <
        lengths[best] * (within.hi[k] - within.lo[k]))
      best = k;
  return best;
}

/// Finds the pairs of triangles of two parts whose boxes overlap, along the coordinate axes or
/// others, by sorting the boxes along one axis, without a tree. Triangles off the box of the other
/// part are dropped first.
class SweepAndPrune {
 public:
  /// `axes`: null for the coordinate axes.
  SweepAndPrune(const PairLocalPart& a, const PairLocalPart& b, const Axes* axes);

  /// Calls `visit(a, b)` for each pair, which returns whether to go on. Returns whether it went to
  /// the end.
  template <class Visit>
  bool run(const Visit& visit) const {
    std::size_t i = 0, j = 0;
    while (i < a_.size() && j < b_.size()) {
      const bool a_starts = a_[i].lo[0] <= b_[j].lo[0];
      const Swept& one = a_starts ? a_[i++] : b_[j++];
      const std::vector<Swept>& others = a_starts ? b_ : a_;
      for (std::size_t k = a_starts ? j : i; k < others.size() && others[k].lo[0] <= one.hi[0];
           ++k) {
        const Swept& other = others[k];
        if (other.lo[1] > one.hi[1] || one.lo[1] > other.hi[1] || other.lo[2] > one.hi[2] ||
            one.lo[2] > other.hi[2])
          continue;
        if (!(a_starts ? visit(one.id, other.id) : visit(other.id, one.id))) return false;
      }
    }
    return true;
  }

 private:
  /// The box of a triangle, the axis that is swept first.
  struct Swept {
    Vec3d lo, hi;
    std::uint32_t id = 0;
  };

  std::vector<Swept> a_, b_;  ///< by lo along the axis
};

}  // namespace strake::geometry
