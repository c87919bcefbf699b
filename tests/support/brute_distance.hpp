// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "strake/geometry/vec.hpp"
#include "strake/model/model.hpp"

namespace strake::test {

using WorldTriangle = std::array<geometry::Vec3d, 3>;

/// An object's triangles in world millimetres, straight from the model: no grid, no welding.
struct WorldObject {
  std::vector<WorldTriangle> triangles;
  geometry::Box3d box = geometry::empty_box<double>();
};

[[nodiscard]] WorldObject world_object(const model::Model& model, const model::Object& object);

/// Pairs (a < b) of objects whose boxes lie within `reach` of each other on every axis; by (a, b).
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> near_boxes(
    const std::vector<WorldObject>& objects, double reach);

/// Least distance between two triangles, in doubles; 0 where they cross.
[[nodiscard]] double triangle_distance(const WorldTriangle& a, const WorldTriangle& b);

/// Least distance between two surfaces over all pairs of triangles, or `reach` if they are farther.
[[nodiscard]] double surface_distance(const WorldObject& a, const WorldObject& b, double reach);

/// True when the ray count of a point says inside; `point` off the surface.
[[nodiscard]] bool inside(const WorldObject& object, const geometry::Vec3d& point);

/// Least distance of a point to a surface.
[[nodiscard]] double point_distance(const WorldObject& object, const geometry::Vec3d& point);

/// A lower bound on the depth of two bodies, from points of a lattice over the common box and
/// climbing from the best of them: max over x in both of max(dist(x, ∂a), dist(x, ∂b)).
[[nodiscard]] double sampled_depth(const WorldObject& a, const WorldObject& b, int steps);

}  // namespace strake::test
