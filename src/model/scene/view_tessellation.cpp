// SPDX-License-Identifier: Apache-2.0
#include "model/scene/view_tessellation.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <variant>

#include "model/scene/grid_shape.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::model {
namespace {

constexpr std::uint32_t kNone = 0xffffffffU;

/// Returns by shape the first body that is drawn with it, or none.
std::vector<std::uint32_t> first_bodies(const Scene& scene, const std::vector<bool>& drawn) {
  std::vector<std::uint32_t> first(scene.shapes.size(), kNone);
  for (std::uint32_t b = 0; b < scene.bodies.size(); ++b) {
    const GridBody& body = scene.bodies[b];
    if ((drawn.empty() || drawn[index(body.object)]) && first[body.grid_shape] == kNone)
      first[body.grid_shape] = b;
  }
  return first;
}

/// Returns the primitive that a shape is made from; an axis stands for its pipe, and is not.
const geometry::Primitive* primitive_of(const Scene& scene, std::uint32_t shape) {
  if (scene.shapes[shape].single_line) return nullptr;
  return std::get_if<geometry::Primitive>(&scene.model->shapes[index(scene.shapes[shape].shape)]);
}

/// Returns by shape whether it is to be finer than in the scene: so is that of a body which may be
/// seen.
std::vector<bool> finer_shapes(const Scene& scene, const std::vector<bool>& drawn,
                               const ViewTessellationOptions& seen_by) {
  if (!(seen_by.sag_mm > 0 && seen_by.sag_mm < scene.sag_mm)) return {};
  std::vector<bool> finer(scene.shapes.size()), curved(scene.shapes.size());
  for (std::uint32_t s = 0; s < curved.size(); ++s) {
    const geometry::Primitive* const primitive = primitive_of(scene, s);
    curved[s] = primitive != nullptr && geometry::is_curved(*primitive);
  }
  for (const GridBody& body : scene.bodies) {
    if (!curved[body.grid_shape] || finer[body.grid_shape] ||
        (!drawn.empty() && !drawn[index(body.object)]))
      continue;
    const geometry::Box3l box = body.box(scene.shapes[body.grid_shape]);
    finer[body.grid_shape] = !box.empty() && (!seen_by.shows || seen_by.shows(box));
  }
  return finer;
}

/// Returns whether a shape is made anew where it is drawn.
bool changes(const Scene& scene, std::uint32_t shape, const ViewTessellationOptions& seen_by,
             const ViewTessellation& plan) {
  if (plan.is_finer(shape)) return true;
  const geometry::Primitive* const primitive = primitive_of(scene, shape);
  return seen_by.towards && primitive != nullptr && geometry::is_round(*primitive);
}

/// Makes a shape anew, or keeps it as it was where the new one does not fit the grid.
GridShape made_for(const Scene& scene, std::uint32_t shape, const geometry::Mat3d& linear,
                   const GridShapeOptions& wanted, GridShapeBuilder& builder) {
  const GridShape& old = scene.shapes[shape];
  GridShapeResult made = builder.make(scene.model->shapes[index(old.shape)], linear, wanted);
  if (!made.fault.empty()) return old;
  made.shape.shape = old.shape;
  return std::move(made.shape);
}

}  // namespace

ViewTessellation plan_view_tessellation(const Scene& scene, const std::vector<bool>& drawn,
                                        const ViewTessellationOptions& seen_by) {
  ViewTessellation plan;
  if (scene.model == nullptr || !(scene.sag_mm > 0)) return plan;
  plan.finer = finer_shapes(scene, drawn, seen_by);
  for (const GridBody& body : scene.bodies) {
    if (!drawn.empty() && !drawn[index(body.object)]) continue;
    plan.any = changes(scene, body.grid_shape, seen_by, plan);
    if (plan.any) break;
  }
  return plan;
}

Result<std::optional<Scene>> tessellate_for_view(const Scene& scene, const std::vector<bool>& drawn,
                                                 const ViewTessellationOptions& seen_by,
                                                 const parallel::Context& context) {
  return tessellate_for_view(scene, drawn, seen_by, plan_view_tessellation(scene, drawn, seen_by),
                             context);
}

Result<std::optional<Scene>> tessellate_for_view(const Scene& scene, const std::vector<bool>& drawn,
                                                 const ViewTessellationOptions& seen_by,
                                                 const ViewTessellation& plan,
                                                 const parallel::Context& context) {
  if (!plan.any) return std::optional<Scene>();
  const std::vector<std::uint32_t> first = first_bodies(scene, drawn);
  // Only shares the work out: between 4 and 64 no difference can be seen (decision 0073).
  constexpr std::size_t kGrain = 16;
  auto shapes = parallel::transform_with(
      context, {.name = "shapes of the view", .n = first.size(), .grain = kGrain},
      [] { return GridShapeBuilder(); },
      [&](GridShapeBuilder& builder, std::size_t i) {
        const auto s = static_cast<std::uint32_t>(i);
        if (first[s] == kNone) {
          GridShape empty;
          empty.shape = scene.shapes[s].shape;
          empty.base = scene.shapes[s].base;
          return empty;
        }
        if (!changes(scene, s, seen_by, plan)) return scene.shapes[s];
        GridShapeOptions wanted{.sag_mm = plan.is_finer(s) ? seen_by.sag_mm : scene.sag_mm};
        if (seen_by.towards) wanted.towards = seen_by.towards->as<double>();
        const Body& body = scene.model->bodies[scene.bodies[first[s]].body];
        return made_for(scene, s, body.placement.linear, wanted, builder);
      });
  if (!shapes) return shapes.error();
  Scene seen;
  seen.model = scene.model;
  seen.bodies = scene.bodies;
  seen.first_body = scene.first_body;
  seen.left_out = scene.left_out;
  seen.diagnostics = scene.diagnostics;
  seen.lacking = scene.lacking;
  seen.sag_mm = scene.sag_mm;
  if (seen_by.sag_mm > 0) seen.sag_mm = std::min(seen.sag_mm, seen_by.sag_mm);
  seen.weld_mm = scene.weld_mm;
  for (GridBody& body : seen.bodies)
    body.origin =
        body.origin - scene.shapes[body.grid_shape].base + (*shapes)[body.grid_shape].base;
  seen.shapes = std::move(*shapes);
  return std::optional<Scene>(std::move(seen));
}

}  // namespace strake::model
