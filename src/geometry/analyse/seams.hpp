// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "strake/geometry/analyse.hpp"

namespace strake::geometry {

/// A welded mesh without triangles of no area.
struct SeamlessMesh {
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> faces;  ///< empty, or one per triangle
  std::uint64_t cut = 0;             ///< triangles that became several
};

/// Takes the triangles without area out of a welded mesh and cuts the triangles beside them, so
/// that directed edges cancel wherever they did before: a-b-c with b between a and c joins one
/// triangle at (a, c) to those at (a, b) and (b, c); without it, the one at (a, c) is cut at b.
/// Nothing moves, and no cut has a sliver of no area.
///
/// `vertices` are distinct and sorted by (x, y, z), so that points of one line are in order along
/// it. Triangles may repeat vertices: these are left out without more, since their edges cancel.
///
/// Nothing where there is nothing to cut, or where zigzags along one line would make the mesh more
/// than five times as large. Depends neither on the order of the triangles nor on their corners'.
[[nodiscard]] std::optional<SeamlessMesh> cut_at_seams(std::span<const Vec3i> vertices,
                                                       std::span<const Triangle> triangles,
                                                       std::span<const std::uint32_t> faces);

}  // namespace strake::geometry
