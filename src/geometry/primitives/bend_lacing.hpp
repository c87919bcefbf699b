// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "strake/geometry/vec.hpp"

// Triangles between neighbouring sections of a bend.

namespace strake::geometry::tessellation {

/// Part of a section's circle: points in the order of their angles.
struct SectionArc {
  std::vector<double> angles;
  std::vector<Vec3d> points;
  std::vector<std::uint32_t> vertices;
};

/// How the band between two arcs is cut into triangles: from the edge between their first points
/// one of the arcs goes on by a point each time. Nothing, where they are too unlike each other.
struct BandLacing {
  std::vector<bool> second_goes_on;
};

/// Returns the lacing of a band that looks towards an eye, or away, with as few triangles as
/// possible that do not by more than `least` on paper; of several the one of the shortest edges.
/// `step` is the usual one between points.
[[nodiscard]] BandLacing lace_band(const SectionArc& first, const SectionArc& second,
                                   const Vec3d& eye, bool faces_eye, double step, double least);

}  // namespace strake::geometry::tessellation
