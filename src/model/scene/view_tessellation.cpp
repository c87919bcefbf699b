// SPDX-License-Identifier: Apache-2.0
#include "model/scene/view_tessellation.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>

#include "model/scene/grid_shape.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/distinct.hpp"
#include "strake/parallel/find.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/lowest.hpp"
#include "strake/parallel/marks.hpp"
#include "strake/parallel/slots.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::model {
namespace {

constexpr std::uint32_t kNone = parallel::Lowest::kNone;

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

// Only shares the work out.
constexpr std::size_t kBodiesPerRun = 4096;

/// Returns by shape whether it is to be finer than in the scene: so is that of a body which may be
/// seen.
Result<std::vector<bool>> finer_shapes(const Scene& scene, const std::vector<bool>& drawn,
                                       const ViewTessellationOptions& tessellation_options,
                                       const parallel::Context& context) {
  std::vector<bool> finer;
  if (!(tessellation_options.sag_mm > 0 && tessellation_options.sag_mm < scene.sag_mm))
    return finer;
  std::vector<bool> curved(scene.shapes.size());
  for (std::uint32_t s = 0; s < curved.size(); ++s) {
    const geometry::Primitive* const primitive = primitive_of(scene, s);
    curved[s] = primitive != nullptr && geometry::is_curved(*primitive);
  }
  parallel::Marks result(scene.shapes.size());
  const Status status = parallel::for_each(
      context, {.name = "shapes that are seen", .n = scene.bodies.size(), .grain = kBodiesPerRun},
      [&](std::size_t b) {
        const GridBody& body = scene.bodies[b];
        if (!curved[body.grid_shape] || result.is_set(body.grid_shape) ||
            (!drawn.empty() && !drawn[index(body.object)]))
          return;
        const geometry::Box3l box = body.box(scene.shapes[body.grid_shape]);
        if (!box.empty() && (!tessellation_options.shows || tessellation_options.shows(box)))
          result.set(body.grid_shape);
      });
  if (!status) return status.error();
  finer.resize(scene.shapes.size());
  for (std::size_t s = 0; s < finer.size(); ++s) finer[s] = result.is_set(s);
  return finer;
}

/// Returns whether a body gets a shape of its own, as an eye sees its contours.
bool is_in_view_of_eye(const Scene& scene, const GridBody& body,
                       const ViewTessellationOptions& tessellation_options) {
  if (!tessellation_options.eye) return false;
  const geometry::Primitive* const primitive = primitive_of(scene, body.grid_shape);
  if (primitive == nullptr || !geometry::is_round(*primitive)) return false;
  const geometry::Box3l box = body.box(scene.shapes[body.grid_shape]);
  return !box.empty() && (!tessellation_options.shows || tessellation_options.shows(box));
}

/// Equal shapes at one place, as of objects that are in a model twice, stay one.
Result<ShapesOfView> shapes_of_view(const Scene& scene, const std::vector<bool>& drawn,
                                    const ViewTessellationOptions& tessellation_options,
                                    const parallel::Context& context) {
  ShapesOfView shapes;
  auto of = parallel::unset_slots<std::uint32_t>(scene.bodies.size());
  if (!of) return of.error();
  shapes.of = std::move(*of);
  parallel::Lowest shared(scene.shapes.size());
  const auto own = parallel::collect<std::uint32_t>(
      context, {.name = "shapes of bodies", .n = scene.bodies.size(), .grain = kBodiesPerRun},
      [&](std::size_t b, std::vector<std::uint32_t>& out) {
        const GridBody& body = scene.bodies[b];
        shapes.of[b] = body.grid_shape;
        if (!drawn.empty() && !drawn[index(body.object)]) return;
        if (is_in_view_of_eye(scene, body, tessellation_options))
          out.push_back(static_cast<std::uint32_t>(b));
        else
          shared.offer(body.grid_shape, b);
      });
  if (!own) return own.error();
  const auto body = [&](std::size_t i) -> const GridBody& { return scene.bodies[(*own)[i]]; };
  const auto kinds = parallel::distinct(
      context, "shapes of their own", own->size(),
      [&](std::size_t i) {
        std::uint64_t hash = parallel::mixed(0, body(i).grid_shape);
        for (int k = 0; k < 3; ++k)
          hash = parallel::mixed(hash, static_cast<std::uint64_t>(body(i).origin[k]));
        return hash;
      },
      [&](std::size_t i, std::size_t j) {
        return body(i).grid_shape == body(j).grid_shape && body(i).origin == body(j).origin;
      });
  if (!kinds) return kinds.error();
  shapes.first.reserve(scene.shapes.size() + kinds->first.size());
  for (std::size_t s = 0; s < scene.shapes.size(); ++s) shapes.first.push_back(shared[s]);
  for (const std::uint32_t i : kinds->first) shapes.first.push_back((*own)[i]);
  const auto shared_shapes = static_cast<std::uint32_t>(scene.shapes.size());
  const Status numbered = parallel::for_each(
      context, {.name = "bodies with their own", .n = own->size(), .grain = kBodiesPerRun},
      [&](std::size_t i) { shapes.of[(*own)[i]] = shared_shapes + kinds->of[i]; });
  if (!numbered) return numbered.error();
  return shapes;
}

/// Returns whether a shape is made anew where it is drawn.
bool changes(const Scene& scene, std::uint32_t shape,
             const ViewTessellationOptions& tessellation_options, const ViewTessellation& plan) {
  if (plan.is_finer(shape)) return true;
  const geometry::Primitive* const primitive = primitive_of(scene, shape);
  return tessellation_options.towards && primitive != nullptr && geometry::is_round(*primitive);
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

Result<ViewTessellation> plan_view_tessellation(const Scene& scene, const std::vector<bool>& drawn,
                                                const ViewTessellationOptions& tessellation_options,
                                                const parallel::Context& context) {
  ViewTessellation plan;
  if (scene.model == nullptr || !(scene.sag_mm > 0)) return plan;
  auto finer = finer_shapes(scene, drawn, tessellation_options, context);
  if (!finer) return finer.error();
  plan.finer = std::move(*finer);
  const auto changed = parallel::find_first(
      context, {.name = "shapes that change", .n = scene.bodies.size(), .grain = kBodiesPerRun},
      [&](std::size_t b) {
        const GridBody& body = scene.bodies[b];
        return (drawn.empty() || drawn[index(body.object)]) &&
               (changes(scene, body.grid_shape, tessellation_options, plan) ||
                is_in_view_of_eye(scene, body, tessellation_options));
      });
  if (!changed) return changed.error();
  plan.any = changed->has_value();
  return plan;
}

Result<std::optional<Scene>> tessellate_for_view(
    const Scene& scene, const std::vector<bool>& drawn,
    const ViewTessellationOptions& tessellation_options, const parallel::Context& context) {
  const Result<ViewTessellation> plan =
      plan_view_tessellation(scene, drawn, tessellation_options, context);
  if (!plan) return plan.error();
  return tessellate_for_view(scene, drawn, tessellation_options, *plan, context);
}

Result<std::optional<Scene>> tessellate_for_view(
    const Scene& scene, const std::vector<bool>& drawn,
    const ViewTessellationOptions& tessellation_options, const ViewTessellation& plan,
    const parallel::Context& context) {
  if (!plan.any) return std::optional<Scene>();
  const Result<ShapesOfView> shapes_of =
      shapes_of_view(scene, drawn, tessellation_options, context);
  if (!shapes_of) return shapes_of.error();
  const ShapesOfView& view = *shapes_of;
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
        if (!own && !changes(scene, s, tessellation_options, plan)) return scene.shapes[s];
        GridShapeOptions wanted{.sag_mm =
                                    plan.is_finer(s) ? tessellation_options.sag_mm : scene.sag_mm};
        if (own)
          wanted.eye =
              geometry::to_mm(*tessellation_options.eye - (body.origin - scene.shapes[s].base));
        else if (tessellation_options.towards)
          wanted.towards = tessellation_options.towards->as<double>();
        return made_for(scene, s, scene.model->bodies[body.body].placement.linear, wanted, builder);
      });
  if (!shapes) return shapes.error();
  Scene result;
  result.model = scene.model;
  result.first_body = scene.first_body;
  result.left_out = scene.left_out;
  result.diagnostics = scene.diagnostics;
  result.lacking = scene.lacking;
  result.sag_mm = scene.sag_mm;
  if (tessellation_options.sag_mm > 0)
    result.sag_mm = std::min(result.sag_mm, tessellation_options.sag_mm);
  result.weld_mm = scene.weld_mm;
  auto bodies = parallel::transform(
      context, {.name = "bodies of the view", .n = scene.bodies.size(), .grain = kBodiesPerRun},
      [&](std::size_t b) {
        GridBody body = scene.bodies[b];
        body.origin = body.origin - scene.shapes[body.grid_shape].base + (*shapes)[view.of[b]].base;
        body.grid_shape = view.of[b];
        return body;
      });
  if (!bodies) return bodies.error();
  result.bodies = std::move(*bodies);
  result.shapes = std::move(*shapes);
  return std::optional<Scene>(std::move(result));
}

}  // namespace strake::model
