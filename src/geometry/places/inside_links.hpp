// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "geometry/places/stretches.hpp"

namespace strake::geometry {

/// The sets of near pairs, and of the vertices of the side beside them: pair i is number i, vertex
/// v number first_vertex + v.
struct InsideSets {
  DisjointSets& sets;
  std::uint32_t first_vertex = 0;
};

/// Joins what the skin of one part joins inside the other, a solid: near pairs between which a
/// stretch of an edge, or of a line across a triangle, runs through the inside, and the vertices
/// in there.
void link_inside(const SolidNear& near, const InsideSets& sets, PairWork& work);

}  // namespace strake::geometry
