// SPDX-License-Identifier: Apache-2.0
#include "project/changes/displaced_bodies.hpp"

#include <cmath>
#include <cstddef>
#include <span>
#include <variant>
#include <vector>

namespace strake::project {
namespace {

using geometry::Vec3d;

/// What numbers cannot distinguish, besides what the grid rounds.
constexpr double kGridMm = 0.001;
constexpr double kMmOfUm = 0.001;

bool is_within(const Vec3d& v, double tolerance) {
  return std::abs(v.x) <= tolerance && std::abs(v.y) <= tolerance && std::abs(v.z) <= tolerance;
}

/// Whether the points are the others, displaced by one vector.
bool is_displaced_by_one(const std::vector<Vec3d>& before, const std::vector<Vec3d>& after,
                         double tolerance) {
  if (before.size() != after.size() || before.empty()) return false;
  const Vec3d displacement = after.front() - before.front();
  for (std::size_t i = 0; i < before.size(); ++i)
    if (!is_within(after[i] - before[i] - displacement, tolerance)) return false;
  return true;
}

/// The vector by which the points of a shape are displaced, in the frame of the shape.
struct Displacement {
  bool is_one = false;  ///< the shapes are the same but for it
  Vec3d vector;
};

Displacement displacement_of(const model::Shape& before, const model::Shape& after,
                             double tolerance) {
  const auto* const old_mesh = std::get_if<geometry::TriangleMesh>(&before);
  const auto* const mesh = std::get_if<geometry::TriangleMesh>(&after);
  if (old_mesh != nullptr && mesh != nullptr) {
    if (old_mesh->triangles != mesh->triangles || old_mesh->faces != mesh->faces ||
        !is_displaced_by_one(old_mesh->vertices, mesh->vertices, tolerance))
      return {};
    return {true, mesh->vertices.front() - old_mesh->vertices.front()};
  }
  const auto* const old_lines = std::get_if<geometry::Polylines>(&before);
  const auto* const lines = std::get_if<geometry::Polylines>(&after);
  if (old_lines == nullptr || lines == nullptr || old_lines->first != lines->first ||
      !is_displaced_by_one(old_lines->points, lines->points, tolerance))
    return {};
  return {true, lines->points.front() - old_lines->points.front()};
}

}  // namespace

bool is_displaced(const model::Model& then, const model::Object& before, const model::Model& now,
                  const model::Object& after) {
  if (before.body_count != after.body_count || before.incomplete != after.incomplete) return false;
  const auto old_bodies =
      std::span(then.bodies).subspan(before.first_body, std::size_t{before.body_count});
  const auto bodies =
      std::span(now.bodies).subspan(after.first_body, std::size_t{after.body_count});
  bool far = false;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const double tolerance = kGridMm + 2 * kMmOfUm *
                                           (static_cast<double>(old_bodies[b].precision_um) +
                                            static_cast<double>(bodies[b].precision_um));
    const Displacement displacement =
        displacement_of(then.shapes[model::index(old_bodies[b].shape)],
                        now.shapes[model::index(bodies[b].shape)], tolerance);
    if (!displacement.is_one) return false;
    far = far || !is_within(displacement.vector, tolerance);
  }
  return far;
}

}  // namespace strake::project
