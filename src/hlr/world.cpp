// SPDX-License-Identifier: Apache-2.0
#include "hlr/world.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "hlr/shape_loop.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/distinct.hpp"
#include "strake/parallel/pieces.hpp"

namespace strake::hlr {
namespace {

using geometry::Box3l;

constexpr std::uint32_t kEdgesPerItem = 32;
/// Of what covers tiles: with more tiles painting them costs more than it spares.
constexpr std::size_t kEdgesPerTile = 16;

bool within(const Box3l& inner, const Box3l& outer) {
  for (int k = 0; k < 3; ++k)
    if (inner.lo[k] < outer.lo[k] || inner.hi[k] > outer.hi[k]) return false;
  return true;
}

/// About the least distance before the eye of what is drawn, its near plane apart.
double nearest_depth(const Job& job) {
  const ViewAxes axes = axes_of(job.view);
  double nearest = std::numeric_limits<double>::infinity();
  for (const model::GridBody& body : job.scene->bodies) {
    const geometry::Box3i& box = job.scene->shapes[body.grid_shape].box;
    if (!job.drawn[model::index(body.object)] || box.empty()) continue;
    for (int corner = 0; corner < 8; ++corner) {
      geometry::Vec3l p = job.offset(body);
      for (int k = 0; k < 3; ++k) p[k] += (corner >> k & 1) != 0 ? box.hi[k] : box.lo[k];
      nearest = std::min(nearest, -dot(axes.toward, p.as<double>()));
    }
  }
  const double near_plane = job.view.perspective->near_mm * geometry::kGridPerMm;
  return std::isfinite(nearest) ? std::max(nearest, near_plane) : near_plane;
}

/// A view of a body's shape for all bodies that share it; in perspective, of each body.
Status make_views(World& world, const parallel::Context& context) {
  const Job& job = world.job;
  const model::Scene& scene = *job.scene;
  const std::size_t views = world.picture ? scene.bodies.size() : job.seen.all.size();
  std::vector<std::uint32_t> body_of(views);
  std::vector<bool> wanted(views);
  for (std::uint32_t b = 0; b < scene.bodies.size(); ++b) {
    if (!job.drawn[model::index(scene.bodies[b].object)]) continue;
    const std::uint32_t view = world.view_of(b);
    if (!wanted[view]) body_of[view] = b;
    wanted[view] = true;
  }
  const auto edges = [&](std::size_t view) {
    std::size_t sum = 0;
    for (const geometry::Part& part : job.seen_of(body_of[view]).source->parts)
      sum += part.edges.size();
    return sum;
  };
  world.views = parallel::Precomputed<ShapeView>(views);
  const Picture* const picture = world.picture ? &*world.picture : nullptr;
  return world.views.fill_by_weight(
      context, {.name = "hidden lines: shapes"}, kBigShape, parallel::keys_of(wanted), edges,
      [&](std::size_t view) {
        const std::uint32_t body = body_of[view];
        return view_of(job.seen_of(body),
                       {world.frame, job.features_of(scene.bodies[body]), picture,
                        job.options.bucketing, job.may_forgive_rounding(), context});
      });
}

/// Leaves those bodies out that hide what others of other objects hide too.
Status leave_out_equal(World& world, std::vector<ViewBox>& boxes,
                       const parallel::Context& context) {
  // An edge, or a line that two objects have in common, asks the others: one of three is left.
  constexpr std::uint32_t kEnough = 3;
  const auto& first_body = world.job.scene->first_body;
  std::vector<std::uint32_t> some;
  for (std::uint32_t b = 0; b < boxes.size(); ++b) {
    const std::uint32_t object = world.placed[b].object;
    if (!boxes[b].empty() && first_body[object + 1] - first_body[object] <= kFewBodies)
      some.push_back(b);
  }
  const auto shape = [&](std::size_t i) { return world.job.seen.of[some[i]]; };
  const auto placed = [&](std::size_t i) -> const Placed& { return world.placed[some[i]]; };
  const auto kinds = parallel::distinct(
      context, "hidden lines: equal bodies", some.size(),
      [&](std::size_t i) {
        std::uint64_t h = parallel::mixed(shape(i), static_cast<std::uint64_t>(placed(i).contact));
        for (int k = 0; k < 3; ++k)
          h = parallel::mixed(h, static_cast<std::uint64_t>(placed(i).offset[k]));
        return h;
      },
      [&](std::size_t i, std::size_t j) {
        return shape(i) == shape(j) && placed(i).offset == placed(j).offset &&
               placed(i).contact == placed(j).contact;
      });
  if (!kinds) return kinds.error();
  struct Kept {
    std::uint32_t objects = 0, last = 0;
  };
  std::vector<Kept> kept(kinds->first.size());
  for (std::size_t i = 0; i < some.size(); ++i) {
    Kept& of_kind = kept[kinds->of[i]];
    const std::uint32_t object = placed(i).object;
    if (of_kind.objects == 0 || of_kind.last != object) ++of_kind.objects;
    of_kind.last = object;
    if (of_kind.objects <= kEnough) continue;
    boxes[some[i]] = {};
    world.placed[some[i]].repeated = true;
  }
  return {};
}

Status place_bodies(World& world, const parallel::Context& context) {
  const Job& job = world.job;
  const model::Scene& scene = *job.scene;
  world.placed.resize(scene.bodies.size());
  std::vector<ViewBox> boxes(scene.bodies.size());
  for (std::uint32_t b = 0; b < scene.bodies.size(); ++b) {
    const model::GridBody& body = scene.bodies[b];
    const std::uint32_t object = model::index(body.object);
    if (!job.drawn[object]) continue;
    const SeenShape& seen = job.seen_of(b);
    const model::GridShape& shape = seen.shape();
    Placed& placed = world.placed[b];
    placed = {world.views.find(world.view_of(b)),
              job.offset(body),
              world.picture ? ViewPoint{} : world.frame(job.offset(body)),
              object,
              job.contact[b],
              seen.within,
              job.opaque[b],
              false,
              job.forgives_rounding(b)};
    if (job.limits && !shape.box.empty()) {
      Box3l box = body.box(shape);
      // Hatch lines lie on the plane itself, which rounded rims are as much as 1.5 units off.
      const std::int64_t beyond = seen.cut != nullptr ? 2 : 0;
      const geometry::Vec3l more{beyond, beyond, beyond};
      box = {box.lo - job.origin - more, box.hi - job.origin + more};
      placed.cut = !within(box, *job.limits);
      placed.opaque = placed.opaque && box.meets(*job.limits);
    }
    if (placed.opaque && !placed.view->box.empty()) boxes[b] = placed.view->box.moved(placed.at);
  }
  if (job.options.culling)
    if (const Status status = leave_out_equal(world, boxes, context); !status) return status;
  world.tree = ViewTree(boxes);
  return {};
}

/// Bodies of one shape that hide, whole, and take the same contact distance between their parts.
void find_sharers(World& world) {
  const SeenShapes& shapes = world.job.seen;
  constexpr std::uint32_t kNone = 0xffffffffU;
  std::vector<std::uint32_t> first(shapes.all.size(), kNone);
  for (std::uint32_t b = 0; b < world.placed.size(); ++b) {
    Placed& placed = world.placed[b];
    if (placed.view == nullptr || !placed.opaque || placed.cut) continue;
    std::uint32_t& one = first[shapes.of[b]];
    if (one == kNone) {
      one = b;
    } else if (placed.contact == world.placed[one].contact) {
      placed.shares_own_hits = world.placed[one].shares_own_hits = true;
    }
  }
}

Status make_coverage(World& world, const parallel::Context& context) {
  const Job& job = world.job;
  if (!job.options.culling || job.options.stage != Stage::global || world.picture) return {};
  std::size_t edges = 0;
  for (const Placed& placed : world.placed)
    if (placed.view != nullptr) edges += placed.view->edges.size();
  std::int64_t contact = job.lines.contact;
  for (const std::int64_t c : job.contact) contact = std::max(contact, c);
  auto coverage = Coverage::of(world.placed, world.frame, contact, edges / kEdgesPerTile, context);
  if (!coverage) return coverage.error();
  world.coverage = std::move(*coverage);
  return {};
}

void make_items(World& world) {
  const model::Scene& scene = *world.job.scene;
  std::uint32_t number = 0;
  const auto add = [&](std::uint32_t body, std::size_t size, bool lines) {
    const auto edges = static_cast<std::uint32_t>(size);
    parallel::cut_evenly(edges, kEdgesPerItem, [&](std::uint32_t first, std::uint32_t last) {
      world.items.push_back({body, first, last, number + first, lines});
    });
    number += edges;
  };
  for (std::uint32_t b = 0; b < scene.bodies.size(); ++b) {
    if (world.placed[b].view == nullptr) continue;
    const std::uint32_t object = world.placed[b].object;
    if (b == scene.first_body[object]) number = 0;
    add(b, world.placed[b].view->edges.size(), false);
    if (b + 1 == scene.first_body[object + 1]) add(b, world.job.lines.of(object).size(), true);
  }
}

}  // namespace

std::vector<Item> own_items(const World& world) {
  const SeenShapes& shapes = world.job.seen;
  std::vector<bool> known(shapes.all.size());
  std::vector<Item> items;
  for (std::uint32_t b = 0; b < world.placed.size(); ++b) {
    if (!world.placed[b].shares_own_hits || known[shapes.of[b]]) continue;
    known[shapes.of[b]] = true;
    const auto edges = static_cast<std::uint32_t>(world.placed[b].view->edges.size());
    parallel::cut_evenly(edges, kEdgesPerItem, [&](std::uint32_t first, std::uint32_t last) {
      items.push_back({.body = b, .first = first, .last = last});
    });
  }
  return items;
}

Result<World> make_world(const Job& job, const parallel::Context& context) {
  World world(job);
  if (job.view.perspective) world.picture.emplace(job.view, nearest_depth(job));
  if (const Status status = make_views(world, context); !status) return status.error();
  if (const Status status = place_bodies(world, context); !status) return status.error();
  if (job.options.culling && job.options.stage != Stage::none && !world.picture)
    find_sharers(world);
  if (const Status status = make_coverage(world, context); !status) return status.error();
  make_items(world);
  return world;
}

}  // namespace strake::hlr
