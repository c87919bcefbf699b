// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "geometry/pair_view.hpp"
#include "geometry/sectors.hpp"

namespace strake::geometry {

/// The triangles round an edge (0..2) of a triangle, ascending.
[[nodiscard]] std::span<const std::uint32_t> star(const Part& part, std::uint32_t triangle,
                                                  int edge);

/// Makes an edge of a triangle the axis.
void start_axis(Sectors& sectors, const PartView& view, std::uint32_t triangle, int edge);

/// Adds the half-planes of the triangles round an edge that lies on the axis.
void add_star(Sectors& sectors, const PartView& view, std::uint32_t triangle, int edge, bool of_b);

/// Adds the two half-planes of a triangle through whose interior the axis runs.
void add_face(Sectors& sectors, const PartView& view, std::uint32_t triangle, bool of_b);

/// The same for an axis through the interior of a face in a coordinate plane, of which a triangle
/// is given.
void add_coordinate_face(Sectors& sectors, const PartView& view, std::uint32_t triangle, bool of_b);

}  // namespace strake::geometry
