// SPDX-License-Identifier: Apache-2.0
#include "hlr/incremental/extents.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "hlr/incremental/partial_scene.hpp"
#include "hlr/prepare/view_job.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/primitive.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::hlr {
namespace {

using geometry::Box3l;

// Only shares the work out: between 1024 and 16'384 no difference can be seen (decision 0073).
constexpr std::size_t kBodiesPerItem = 4096;
/// A tessellation lies within its sag of the true surface, and one for a view, whose chords may be
/// a quarter longer, within 1.6 times as much; snapping moves the corners of both by less than one.
constexpr double kSags = 3;
constexpr std::int64_t kSnaps = 4;
/// Hatch lines lie on a section plane, off which rounding moves the rims of caps by 1.5 at most.
constexpr std::int64_t kBeyondCaps = 4;

ShapeExtent extent_of(const model::GridShape& shape) {
  ShapeExtent extent;
  if (shape.box.empty()) return extent;
  extent.box = shape.box.as<std::int64_t>();
  if (!is_made_for_views(shape)) return extent;
  double sag = 0;
  for (const geometry::Part& part : shape.parts) sag = std::max(sag, part.sag);
  extent.margin = static_cast<std::int64_t>(std::ceil(kSags * sag)) + kSnaps;
  return extent;
}

bool is_drawn(const std::vector<bool>& drawn, model::ObjectId object) {
  return drawn.empty() || drawn[model::index(object)];
}

/// What is certain of the extent of all that is drawn.
struct Bounds {
  Box3l inner = geometry::empty_box<std::int64_t>();  ///< lies in the box that is sought
  std::int64_t longest_side = 0, contact = 0;

  void include(const ShapeExtent& extent, const geometry::Vec3l& origin) {
    Box3l box = extent.box.moved(origin);
    for (int k = 0; k < 3; ++k) {
      longest_side = std::max(longest_side, box.hi[k] - box.lo[k]);
      const std::int64_t inwards = std::min(extent.margin, (box.hi[k] - box.lo[k]) / 2);
      box.lo[k] += inwards;
      box.hi[k] -= inwards;
    }
    inner.include(box);
  }
  void include(const Bounds& more) {
    inner.include(more.inner);
    longest_side = std::max(longest_side, more.longest_side);
    contact = std::max(contact, more.contact);
  }
};

/// Returns the box of some objects as the view tessellates them.
Result<Box3l> box_in_view(const model::Scene& scene, const std::vector<bool>& objects,
                          const model::ViewTessellationOptions& tessellation_options,
                          const model::ViewTessellation& plan, const parallel::Context& context) {
  const PartialScene part = scene_of(scene, objects);
  auto own = model::tessellate_for_view(part.scene, objects, tessellation_options, part.plan(plan),
                                        context);
  if (!own) return own.error();
  const model::Scene& shown = *own ? **own : part.scene;
  Box3l box = geometry::empty_box<std::int64_t>();
  for (const model::GridBody& body : shown.bodies) {
    const model::GridShape& shape = shown.shapes[body.grid_shape];
    if (!shape.box.empty()) box.include(body.box(shape));
  }
  return box;
}

}  // namespace

bool is_made_for_views(const model::GridShape& shape) {
  return std::ranges::any_of(shape.parts, [](const geometry::Part& part) {
    return part.primitive && geometry::is_curved(*part.primitive);
  });
}

Result<std::vector<ShapeExtent>> shape_extents(const model::Scene& scene,
                                               const parallel::Context& context) {
  return parallel::transform(context,
                             {.name = "extents of shapes", .n = scene.shapes.size(), .grain = 256},
                             [&](std::size_t s) { return extent_of(scene.shapes[s]); });
}

Result<std::vector<Box3l>> object_extents(const model::Scene& scene, const std::vector<bool>& drawn,
                                          const View& view, std::span<const ShapeExtent> shapes,
                                          const parallel::Context& context) {
  const std::int64_t beyond = view.sections.empty() ? 0 : kBeyondCaps;
  return parallel::transform(
      context,
      {.name = "extents of objects", .n = scene.model->objects.size(), .grain = kBodiesPerItem},
      [&](std::size_t o) {
        Box3l box = geometry::empty_box<std::int64_t>();
        if (!drawn.empty() && !drawn[o]) return box;
        for (const model::GridBody& body :
             scene.bodies_of(model::ObjectId{static_cast<std::uint32_t>(o)})) {
          const Box3l outer = shapes[body.grid_shape].outer();
          if (!outer.empty()) box.include(outer.moved(body.origin).inflated(beyond));
        }
        return box;
      });
}

Result<DrawnExtent> drawn_extent(const model::Scene& scene, const std::vector<bool>& drawn,
                                 std::span<const ShapeExtent> shapes,
                                 const model::ViewTessellationOptions& tessellation_options,
                                 const model::ViewTessellation& plan, const Options& options,
                                 const parallel::Context& context) {
  const auto bounds = parallel::reduce(
      context,
      {.name = "extent of what is drawn", .n = scene.bodies.size(), .grain = kBodiesPerItem},
      Bounds(),
      [&](Bounds& sum, std::size_t b) {
        const model::GridBody& body = scene.bodies[b];
        if (!is_drawn(drawn, body.object)) return;
        sum.contact = std::max(sum.contact, contact_of(scene.model->bodies[body.body], options));
        const ShapeExtent& extent = shapes[body.grid_shape];
        if (!extent.box.empty()) sum.include(extent, body.origin);
      },
      [](Bounds& sum, const Bounds& more) { sum.include(more); });
  if (!bounds) return bounds.error();
  // Only these may reach beyond what is certain.
  const auto outmost = parallel::collect<std::uint32_t>(
      context, {.name = "outmost bodies", .n = scene.bodies.size(), .grain = kBodiesPerItem},
      [&](std::size_t b, std::vector<std::uint32_t>& out) {
        const model::GridBody& body = scene.bodies[b];
        const ShapeExtent& extent = shapes[body.grid_shape];
        if (extent.margin > 0 && is_drawn(drawn, body.object) &&
            !bounds->inner.contains(extent.outer().moved(body.origin)))
          out.push_back(model::index(body.object));
      });
  if (!outmost) return outmost.error();
  DrawnExtent extent{bounds->inner, bounds->longest_side, bounds->contact};
  if (outmost->empty()) return extent;
  std::vector<bool> objects(scene.model->objects.size());
  for (const std::uint32_t object : *outmost) objects[object] = true;
  const auto box = box_in_view(scene, objects, tessellation_options, plan, context);
  if (!box) return box.error();
  extent.box.include(*box);
  return extent;
}

WholeView WholeExtent::view_of(std::span<const Hatch> hatches) const {
  return {.box = drawn.box,
          .longest_side = static_cast<double>(drawn.longest_side),
          .tessellation = {},
          .hatches = hatches,
          .to_solve = {}};
}

Result<WholeExtent> whole_extent(const model::Scene& scene, const std::vector<bool>& drawn,
                                 const View& view, const Options& options,
                                 const parallel::Context& context) {
  const auto tessellation_options = tessellation_of(view, options);
  if (!tessellation_options) return tessellation_options.error();
  WholeExtent whole;
  auto plan = plan_view_tessellation(scene, drawn, *tessellation_options, context);
  if (!plan) return plan.error();
  whole.tessellation = std::move(*plan);
  const auto shapes = shape_extents(scene, context);
  if (!shapes) return shapes.error();
  auto boxes = object_extents(scene, drawn, view, *shapes, context);
  if (!boxes) return boxes.error();
  whole.boxes = std::move(*boxes);
  const auto extent = drawn_extent(scene, drawn, *shapes, *tessellation_options, whole.tessellation,
                                   options, context);
  if (!extent) return extent.error();
  whole.drawn = *extent;
  const bool finer = whole.tessellation.any && options.sag_mm > 0;
  whole.sag_mm = finer ? std::min(scene.sag_mm, options.sag_mm) : scene.sag_mm;
  return whole;
}

}  // namespace strake::hlr
