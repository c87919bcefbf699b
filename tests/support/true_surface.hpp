// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>
#include <vector>

#include "strake/geometry/mesh.hpp"
#include "strake/geometry/primitive.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::test {

/// Points of the true surface of a primitive in its local frame, from the definitions of
/// docs/formats/primitives.md and the C library's trigonometry.
[[nodiscard]] std::vector<geometry::Vec3d> surface_points(const geometry::Primitive& primitive,
                                                          std::size_t count,
                                                          std::mt19937_64& random);

/// Points of the two outlines of a snout's ends, along generators at even angles.
[[nodiscard]] std::vector<geometry::Vec3d> snout_outlines(const geometry::SnoutPrimitive& snout,
                                                          std::size_t count);

/// An upper bound on the distance of a local point near the surface to the true surface, tight
/// where the surface is smooth.
[[nodiscard]] double distance_to_primitive(const geometry::Primitive& primitive,
                                           const geometry::Vec3d& p);

/// Distance of a point to the nearest triangle.
[[nodiscard]] double distance_to_mesh(const geometry::TriangleMesh& mesh, const geometry::Vec3d& p);

}  // namespace strake::test
