// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/near_walk.hpp"

namespace strake::geometry {

struct NearQuestion {
  double reach = 0;        ///< grid units
  std::uint64_t most = 0;  ///< pairs
  bool sharp = false;      ///< whether the distances matter, or only who is near whom
};

/// All pairs of triangles no farther apart than the reach, by (a, b), with certain bounds on their
/// distances, as tight as doubles give them where `sharp`; nothing where there are too many. Parts
/// without trees, which should be small, are walked triangle by triangle.
[[nodiscard]] std::optional<std::vector<NearTriangles>> near_triangles(const PartView& a,
                                                                       const PartView& b,
                                                                       const NearQuestion& question,
                                                                       PairWork& work);

/// Makes the bounds as tight as those of a sharp question.
void sharpen(const PartView& a, const PartView& b, std::vector<NearTriangles>& pairs);

}  // namespace strake::geometry
