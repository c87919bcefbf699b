// SPDX-License-Identifier: Apache-2.0
#include "model/scene/view_tessellation.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <variant>

#include "model/scene/grid_shape.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::model {
namespace {

constexpr std::uint32_t kNone = 0xffffffffU;

/// Which shape each body of a view has: one of the scene's, or behind those one of its own.
struct ShapesOfView {
  std::vector<std::uint32_t> of;     ///< by body
  std::vector<std::uint32_t> first;  ///< by shape: the first body that is drawn with it, or none
};

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

/// Returns whether a body gets a shape of its own, as an eye sees its contours.
bool is_seen_from_eye(const Scene& scene, const GridBody& body,
                      const ViewTessellationOptions& seen_by) {
  if (!seen_by.eye) return false;
  const geometry::Primitive* const primitive = primitive_of(scene, body.grid_shape);
  if (primitive == nullptr || !geometry::is_round(*primitive)) return false;
  const geometry::Box3l box = body.box(scene.shapes[body.grid_shape]);
  return !box.empty() && (!seen_by.shows || seen_by.shows(box));
}

/// Equal shapes at one place, as of objects that are in a model twice, stay one.
ShapesOfView shapes_of_view(const Scene& scene, const std::vector<bool>& drawn,
                            const ViewTessellationOptions& seen_by) {
  ShapesOfView shapes;
  shapes.of.reserve(scene.bodies.size());
  shapes.first.assign(scene.shapes.size(), kNone);
  const auto place = [&](std::uint32_t b) {
    const GridBody& body = scene.bodies[b];
    return std::tuple(body.grid_shape, body.origin.x, body.origin.y, body.origin.z);
  };
  std::vector<std::uint32_t> own;
  for (std::uint32_t b = 0; b < scene.bodies.size(); ++b) {
    const GridBody& body = scene.bodies[b];
    shapes.of.push_back(body.grid_shape);
    if (!drawn.empty() && !drawn[index(body.object)]) continue;
    if (is_seen_from_eye(scene, body, seen_by))
      own.push_back(b);
    else if (shapes.first[body.grid_shape] == kNone)
      shapes.first[body.grid_shape] = b;
  }
  std::ranges::sort(own, {}, [&](std::uint32_t b) { return std::pair(place(b), b); });
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (i == 0 || place(own[i]) != place(own[i - 1])) shapes.first.push_back(own[i]);
    shapes.of[own[i]] = static_cast<std::uint32_t>(shapes.first.size() - 1);
  }
  return shapes;
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
    plan.any =
        changes(scene, body.grid_shape, seen_by, plan) || is_seen_from_eye(scene, body, seen_by);
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
  const ShapesOfView view = shapes_of_view(scene, drawn, seen_by);
  // Only shares the work out: between 4 and 64 no difference can be seen (decision 0073).
  constexpr std::size_t kGrain = 16;
  auto shapes = parallel::transform_with(
      context, {.name = "shapes of the view", .n = view.first.size(), .grain = kGrain},
      [] { return GridShapeBuilder(); },
      [&](GridShapeBuilder& builder, std::size_t i) {
        const bool own = i >= scene.shapes.size();
        if (view.first[i] == kNone) {
          GridShape empty;
          empty.shape = scene.shapes[i].shape;
          empty.base = scene.shapes[i].base;
          return empty;
        }
        const GridBody& body = scene.bodies[view.first[i]];
        const std::uint32_t s = body.grid_shape;
        if (!own && !changes(scene, s, seen_by, plan)) return scene.shapes[s];
        GridShapeOptions wanted{.sag_mm = plan.is_finer(s) ? seen_by.sag_mm : scene.sag_mm};
        if (own)
          wanted.eye = geometry::to_mm(*seen_by.eye - (body.origin - scene.shapes[s].base));
        else if (seen_by.towards)
          wanted.towards = seen_by.towards->as<double>();
        return made_for(scene, s, scene.model->bodies[body.body].placement.linear, wanted, builder);
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
  for (std::size_t b = 0; b < seen.bodies.size(); ++b) {
    GridBody& body = seen.bodies[b];
    body.origin = body.origin - scene.shapes[body.grid_shape].base + (*shapes)[view.of[b]].base;
    body.grid_shape = view.of[b];
  }
  seen.shapes = std::move(*shapes);
  return std::optional<Scene>(std::move(seen));
}

}  // namespace strake::model
