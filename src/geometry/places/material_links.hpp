// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "geometry/places/stretches.hpp"

namespace strake::geometry {

/// Joins near pairs of one triangle of a part and two places on the skin of the other, a solid,
/// between which its material lies within reach of the triangle: the outer and the inner skin of a
/// pipe, the two faces of a plate. Returns how many sets fewer there are.
std::size_t link_material(const SolidNear& near, DisjointSets& sets, PairWork& work);

}  // namespace strake::geometry
