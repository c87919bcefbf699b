// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "strake/geometry/part.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {

using Axes = std::array<Vec3d, 3>;  ///< orthonormal

/// A frame for the common box of two parts, along the normal of a triangle of the first, where they
/// meet, and a face of that part square to it: what meets there is flat in this frame even when the
/// model stands askew. That of the world where there is no such triangle.
///
/// A normal is off by a grid unit or two over the width of its face, and many more over the length
/// of a beam that the face is the end of. The longest edges along the axes, of both parts, make the
/// frame as true as it can be: within a grid unit or two for all of what they belong to.
[[nodiscard]] Axes search_frame(const Part& part, std::uint32_t triangle, const Part& other);

}  // namespace strake::geometry
