// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "strake/geometry/mesh.hpp"

/// Builds the triangle mesh of an object from shared vertices and polygons.
namespace strake::io {

/// Renumbers indices from 0 in their ascending order and returns what each new number stood for; an
/// object takes its own vertices out of a pool that many share in this way. Time and memory follow
/// the number of indices, never the size of the pool.
[[nodiscard]] std::vector<std::uint32_t> renumber_indices(std::vector<std::uint32_t>& indices);

/// Appends a polygon, given by indices into mesh.vertices, as triangles of the same sense. Returns
/// false when its contour crosses itself or encloses nothing: it is then cut as a fan, which keeps
/// its edges, so that a solid stays closed.
bool append_polygon(geometry::TriangleMesh& mesh, std::span<const std::uint32_t> corners);

}  // namespace strake::io
