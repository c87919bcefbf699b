// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/geometry/primitive.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::test {

/// How deep a point of the local frame lies in the true body of a primitive: the distance to its
/// skin, millimetres, within 1e-9 of its size. Outside it is negative, and how far only near the
/// skin. From the definitions of docs/formats/primitives.md and the C library's functions.
[[nodiscard]] double depth_in(const geometry::Primitive& primitive, const geometry::Vec3d& p);

}  // namespace strake::test
