// SPDX-License-Identifier: Apache-2.0
#include "page/geometry/shown_objects.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <variant>

#include "page/geometry/near_points.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::page {
namespace {

/// How many shapes a page may have that nobody requested: it is to open in some seconds.
struct ShapeBudget {
  std::uint64_t shape_bytes = 24'000'000;  ///< before they are compressed
  std::uint64_t instances = 250'000;
  std::uint64_t triangles = 3'000'000;  ///< of all instances

  [[nodiscard]] bool holds(const ShapeBudget& other) const {
    return other.shape_bytes <= shape_bytes && other.instances <= instances &&
           other.triangles <= triangles;
  }
  void take(const ShapeBudget& other) {
    shape_bytes -= other.shape_bytes;
    instances -= other.instances;
    triangles -= other.triangles;
  }
};
constexpr ShapeBudget kNothing{0, 0, 0};

/// What a shape takes, once and for each of its instances.
struct ShapeCost {
  std::uint64_t bytes = 0, triangles = 0;
};

ShapeCost cost_of(const model::GridShape& shape, const model::Model& model) {
  // Most primitives are scaled from a unit that all others share.
  constexpr std::uint64_t kPrimitiveTriangles = 60;
  if (std::holds_alternative<geometry::Primitive>(model.shapes[model::index(shape.shape)]))
    return {0, kPrimitiveTriangles};
  ShapeCost cost;
  for (const geometry::Part& part : shape.parts) {
    // A line is a triangle, too; no part has both.
    const std::size_t triangles =
        part.kind == geometry::PartKind::wire ? part.vertices.size() : part.triangles.size();
    if (triangles == 0) continue;
    cost.bytes += 6 * (part.vertices.size() + triangles);
    cost.triangles += triangles;
  }
  return cost;
}

/// Gives room to objects, first come, first served.
class ShapeChooser {
 public:
  ShapeChooser(const model::Scene& scene, std::vector<ShapeCost> costs, ShownObjects& chosen)
      : scene_(scene), costs_(std::move(costs)), has_(costs_.size(), false), chosen_(chosen) {}

  /// Returns what the objects take, each shape once.
  [[nodiscard]] ShapeBudget all() const {
    std::vector<bool> counted(costs_.size(), false);
    ShapeBudget sum = kNothing;
    for (const model::GridBody& body : scene_.bodies)
      if (chosen_.of[model::index(body.object)] != ShownAs::nothing)
        add(sum, counted, body.grid_shape);
    return sum;
  }
  void show(model::ObjectId object) {
    ShownAs& shown = chosen_.of[model::index(object)];
    if (shown != ShownAs::box) return;
    ShapeBudget needed = kNothing;
    std::vector<std::uint32_t> fresh;
    for (const model::GridBody& body : scene_.bodies_of(object)) {
      if (!has_[body.grid_shape]) fresh.push_back(body.grid_shape);
      add(needed, has_, body.grid_shape);
    }
    if (!left_.holds(needed)) {
      for (const std::uint32_t shape : fresh) has_[shape] = false;
      chosen_.is_full = true;
      return;
    }
    left_.take(needed);
    shown = ShownAs::shape;
  }

 private:
  void add(ShapeBudget& sum, std::vector<bool>& counted, std::uint32_t shape) const {
    const ShapeCost& cost = costs_[shape];
    if (!counted[shape]) sum.shape_bytes += cost.bytes;
    counted[shape] = true;
    ++sum.instances;
    sum.triangles += cost.triangles;
  }

  const model::Scene& scene_;
  std::vector<ShapeCost> costs_;
  std::vector<bool> has_;
  ShapeBudget left_;
  ShownObjects& chosen_;
};

/// Returns which objects come near a place.
Result<std::vector<std::uint8_t>> near_objects(const model::Scene& scene,
                                               const std::vector<geometry::Vec3d>& places,
                                               const parallel::Context& context) {
  constexpr std::size_t kGrain = 1024;
  const NearPoints points(places, kReachMm);
  return parallel::transform(
      context, {.name = "objects near clashes", .n = scene.model->objects.size(), .grain = kGrain},
      [&](std::size_t o) -> std::uint8_t {
        const auto bodies = scene.bodies_of(model::ObjectId{static_cast<std::uint32_t>(o)});
        return std::ranges::any_of(bodies,
                                   [&](const model::GridBody& body) {
                                     return points.is_near(body.box(scene.shapes[body.grid_shape]));
                                   })
                   ? 1
                   : 0;
      });
}

Status show_by_priority(ShapeChooser& chooser, const model::Scene& scene,
                        const ShowPriorities& priorities, const parallel::Context& context) {
  for (const model::ObjectId object : priorities.first) chooser.show(object);
  const Result<std::vector<std::uint8_t>> near = near_objects(scene, priorities.places_mm, context);
  if (!near) return near.error();
  for (std::uint32_t o = 0; o < near->size(); ++o)
    if ((*near)[o] != 0) chooser.show(model::ObjectId{o});
  for (const model::ObjectId object : priorities.last) chooser.show(object);
  return {};
}

}  // namespace

Result<ShownObjects> choose_shown(const model::Scene& scene, const ShowPriorities& priorities,
                                  const parallel::Context& context) {
  using report::ModelShown;
  ShownObjects chosen;
  chosen.of.assign(scene.model->objects.size(), ShownAs::nothing);
  if (priorities.how == ModelShown::nothing) return chosen;
  for (const model::GridBody& body : scene.bodies)
    if (priorities.drawn.empty() || priorities.drawn[model::index(body.object)])
      chosen.of[model::index(body.object)] = ShownAs::box;
  if (priorities.how == ModelShown::boxes) return chosen;
  std::vector<ShapeCost> costs;
  costs.reserve(scene.shapes.size());
  for (const model::GridShape& shape : scene.shapes) costs.push_back(cost_of(shape, *scene.model));
  ShapeChooser chooser(scene, std::move(costs), chosen);
  const bool fits = priorities.how == ModelShown::automatic && ShapeBudget{}.holds(chooser.all());
  if (fits || priorities.how == ModelShown::all) {
    for (ShownAs& shown : chosen.of)
      if (shown == ShownAs::box) shown = ShownAs::shape;
    return chosen;
  }
  chosen.is_near_only = true;
  if (const Status status = show_by_priority(chooser, scene, priorities, context); !status)
    return status.error();
  return chosen;
}

}  // namespace strake::page
