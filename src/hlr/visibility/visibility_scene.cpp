// SPDX-License-Identifier: Apache-2.0
// Building the scene that the solvers query, and edge queries.
#include "hlr/visibility/visibility_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "hlr/edges/element_loop.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/hlr/steps.hpp"
#include "strake/parallel/distinct.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/pieces.hpp"
#include "strake/parallel/report.hpp"

namespace strake::hlr {
namespace {

using geometry::Box3l;

// Only shares the work out: between 8 and 128 no difference can be seen (decision 0073).
constexpr std::uint32_t kEdgesPerItem = 32;
/// For the occlusion buffer: with more tiles painting them costs more than it saves. With so many,
/// 0.4 faces are tested per edge of 20,000 boxes about 100 deep, 3 to 6 in a ship (docs/hlr.md).
constexpr std::size_t kEdgesPerTile = 16;

bool within(const Box3l& inner, const Box3l& outer) {
  for (int k = 0; k < 3; ++k)
    if (inner.lo[k] < outer.lo[k] || inner.hi[k] > outer.hi[k]) return false;
  return true;
}

/// Returns about the least distance before the eye of what is drawn, regardless of the near plane.
double nearest_depth(const ViewJob& job) {
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

/// Projects each shape for all bodies that share it; in perspective, for each body.
Status project_shapes(VisibilityScene& visibility, const parallel::Context& context) {
  const parallel::StageTimer timer(context.report, kLocalStep);
  const ViewJob& job = visibility.job;
  const model::Scene& scene = *job.scene;
  const std::size_t shapes = visibility.perspective_map ? scene.bodies.size() : job.seen.all.size();
  std::vector<std::uint32_t> body_of(shapes);
  std::vector<bool> wanted(shapes);
  for (std::uint32_t b = 0; b < scene.bodies.size(); ++b) {
    if (!job.drawn[model::index(scene.bodies[b].object)]) continue;
    const std::uint32_t shape = visibility.shape_number(b);
    if (!wanted[shape]) body_of[shape] = b;
    wanted[shape] = true;
  }
  const auto edges = [&](std::size_t shape) {
    std::size_t sum = 0;
    for (const geometry::Part& part : job.sectioned_shape_of(body_of[shape]).source->parts)
      sum += part.edges.size();
    return sum;
  };
  visibility.shapes = parallel::Precomputed<ProjectedShape>(shapes);
  const PerspectiveMap* const perspective_map =
      visibility.perspective_map ? &*visibility.perspective_map : nullptr;
  return visibility.shapes.fill_by_weight(
      context, {.name = "hidden lines: shapes"}, kBigShape, parallel::keys_of(wanted), edges,
      [&](std::size_t shape) {
        const std::uint32_t body = body_of[shape];
        return project_shape(
            job.sectioned_shape_of(body),
            {visibility.projection, job.features_of(scene.bodies[body]), perspective_map,
             job.options.bucketing, job.may_forgive_rounding(), context});
      });
}

/// Finds which of some bodies stand in one column.
Result<parallel::Distinct> find_columns(const VisibilityScene& visibility,
                                        const std::vector<std::uint32_t>& bodies,
                                        const parallel::Context& context) {
  const auto shape = [&](std::size_t i) { return visibility.shape_number(bodies[i]); };
  const auto placed = [&](std::size_t i) -> const BodyInstance& {
    return visibility.placed[bodies[i]];
  };
  return parallel::distinct(
      context, "hidden lines: bodies in line", bodies.size(),
      [&](std::size_t i) {
        std::uint64_t h = parallel::mixed(shape(i), static_cast<std::uint64_t>(placed(i).contact));
        h = parallel::mixed(h, static_cast<std::uint64_t>(placed(i).at.u));
        return parallel::mixed(h, static_cast<std::uint64_t>(placed(i).at.v));
      },
      [&](std::size_t i, std::size_t j) {
        const BodyInstance &x = placed(i), &y = placed(j);
        return shape(i) == shape(j) && x.at.u == y.at.u && x.at.v == y.at.v &&
               x.contact == y.contact && !x.cut && !y.cut;
      });
}

/// Marks the bodies of a column, nearest first, that hide only what bodies of other objects at the
/// same place hide, too.
void mark_repeated(VisibilityScene& visibility, std::span<const std::uint32_t> column) {
  // A line may belong to two objects and is tested against the others: of three one is left.
  constexpr std::uint32_t kEnough = 3;
  const auto& first_body = visibility.job.scene->first_body;
  std::uint32_t objects = 0, last = 0;
  const BodyInstance* before = nullptr;
  for (const std::uint32_t b : column) {
    BodyInstance& placed = visibility.placed[b];
    if (first_body[placed.object + 1] - first_body[placed.object] > kFewBodies) continue;
    if (before == nullptr || before->at.w != placed.at.w) objects = 0;
    if (objects == 0 || last != placed.object) ++objects;
    last = placed.object;
    before = &placed;
    placed.repeated = objects > kEnough;
  }
}

/// Puts the bodies that may hide, those with a box, into columns and a tree over these.
Status make_columns(VisibilityScene& visibility, std::span<const ViewBox> boxes,
                    const parallel::Context& context) {
  std::vector<std::uint32_t> some;
  for (std::uint32_t b = 0; b < boxes.size(); ++b)
    if (!boxes[b].empty()) some.push_back(b);
  const auto found = find_columns(visibility, some, context);
  if (!found) return found.error();
  BodyColumns& columns = visibility.columns;
  const std::size_t count = found->first.size();
  std::vector<std::uint32_t> end(count + 1);
  for (const std::uint32_t c : found->of) ++end[c + 1];
  std::partial_sum(end.begin(), end.end(), end.begin());
  columns.bodies.resize(some.size());
  std::vector<std::uint32_t> next = end;
  for (std::size_t i = 0; i < some.size(); ++i) columns.bodies[next[found->of[i]]++] = some[i];
  std::vector<ViewBox> nearest(count);
  std::uint32_t kept = 0;
  for (std::uint32_t c = 0; c < count; ++c) {
    const auto column = std::span(columns.bodies).subspan(end[c], end[c + 1] - end[c]);
    std::ranges::sort(column, [&](std::uint32_t x, std::uint32_t y) {
      const std::int64_t at_x = visibility.placed[x].at.w, at_y = visibility.placed[y].at.w;
      return at_x != at_y ? at_x > at_y : x < y;
    });
    nearest[c] = boxes[column.front()];
    if (visibility.job.options.culling) mark_repeated(visibility, column);
    columns.first.push_back(kept);
    for (const std::uint32_t b : column)
      if (!visibility.placed[b].repeated) columns.bodies[kept++] = b;
  }
  columns.first.push_back(kept);
  columns.bodies.resize(kept);
  auto tree = ViewBvh::of(nearest, context);
  if (!tree) return tree.error();
  visibility.tree = std::move(*tree);
  return {};
}

Status place_bodies(VisibilityScene& visibility, const parallel::Context& context) {
  const ViewJob& job = visibility.job;
  const model::Scene& scene = *job.scene;
  visibility.placed.resize(scene.bodies.size());
  std::vector<ViewBox> boxes(scene.bodies.size());
  const auto place = [&](std::size_t index) {
    const auto b = static_cast<std::uint32_t>(index);
    const model::GridBody& body = scene.bodies[b];
    const std::uint32_t object = model::index(body.object);
    if (!job.drawn[object]) return;
    const SectionedShape& seen = job.sectioned_shape_of(b);
    const model::GridShape& shape = seen.shape();
    BodyInstance& placed = visibility.placed[b];
    placed = {visibility.shapes.find(visibility.shape_number(b)),
              job.offset(body),
              visibility.perspective_map ? ViewPoint{} : visibility.projection(job.offset(body)),
              object,
              job.contact[b],
              seen.within,
              job.opaque[b],
              false,
              job.forgives_rounding(b)};
    if (job.limits && !shape.box.empty()) {
      Box3l box = body.box(shape);
      // Hatch lines lie on the plane itself, and rounded rims up to 1.5 units off it.
      const std::int64_t beyond = seen.cut != nullptr ? 2 : 0;
      const geometry::Vec3l more{beyond, beyond, beyond};
      box = {box.lo - job.origin - more, box.hi - job.origin + more};
      placed.cut = !within(box, *job.limits);
      placed.opaque = placed.opaque && box.meets(*job.limits);
    }
    if (placed.opaque && !placed.shape->box.empty()) boxes[b] = placed.shape->box.moved(placed.at);
  };
  if (Status status = parallel::for_each(
          context, {.name = "hidden lines: bodies", .n = scene.bodies.size(), .grain = 1024},
          place);
      !status)
    return status;
  return make_columns(visibility, boxes, context);
}

/// Marks whole bodies of one shape that hide and have the same contact distance between their
/// parts.
void mark_shared_self_occlusion(VisibilityScene& visibility) {
  const SectionedShapes& shapes = visibility.job.seen;
  constexpr std::uint32_t kNoShape = 0xffffffffU;
  std::vector<std::uint32_t> first(shapes.all.size(), kNoShape);
  for (std::uint32_t b = 0; b < visibility.placed.size(); ++b) {
    BodyInstance& placed = visibility.placed[b];
    if (placed.shape == nullptr || !placed.opaque || placed.cut ||
        !visibility.job.asks_for(placed.object))
      continue;
    std::uint32_t& one = first[shapes.of[b]];
    if (one == kNoShape) {
      one = b;
    } else if (placed.contact == visibility.placed[one].contact) {
      placed.shares_self_occlusion = visibility.placed[one].shares_self_occlusion = true;
    }
  }
}

Status make_occlusion_buffer(VisibilityScene& visibility, const parallel::Context& context) {
  const ViewJob& job = visibility.job;
  if (!job.options.culling || job.options.stage != Stage::global || visibility.perspective_map)
    return {};
  std::size_t edges = 0;
  for (const BodyInstance& placed : visibility.placed)
    if (placed.shape != nullptr) edges += placed.shape->edges.size();
  std::int64_t contact = job.lines.contact;
  for (const std::int64_t c : job.contact) contact = std::max(contact, c);
  auto occlusion_buffer = OcclusionBuffer::of(visibility.placed, visibility.projection, contact,
                                              edges / kEdgesPerTile, context);
  if (!occlusion_buffer) return occlusion_buffer.error();
  visibility.occlusion_buffer = std::move(*occlusion_buffer);
  return {};
}

void make_items(VisibilityScene& visibility) {
  const model::Scene& scene = *visibility.job.scene;
  std::uint32_t number = 0;
  const auto add = [&](std::uint32_t body, std::size_t size, bool lines) {
    const auto edges = static_cast<std::uint32_t>(size);
    parallel::cut_evenly(edges, kEdgesPerItem, [&](std::uint32_t first, std::uint32_t last) {
      visibility.items.push_back({body, first, last, number + first, lines});
    });
    number += edges;
  };
  std::size_t first_item = 0;
  for (std::uint32_t b = 0; b < scene.bodies.size(); ++b) {
    const std::uint32_t object = visibility.placed[b].object;
    if (visibility.placed[b].shape == nullptr || !visibility.job.asks_for(object)) continue;
    if (b == scene.first_body[object]) {
      number = 0;
      first_item = visibility.items.size();
    }
    add(b, visibility.placed[b].shape->edges.size(), false);
    if (b + 1 != scene.first_body[object + 1]) continue;
    add(b, visibility.job.lines.of(object).size(), true);
    if (visibility.items.size() == first_item + 1)
      visibility.items.back().whole = !visibility.items.back().lines;
  }
}

}  // namespace

std::vector<EdgeRange> self_occlusion_ranges(const VisibilityScene& visibility) {
  const SectionedShapes& shapes = visibility.job.seen;
  std::vector<bool> known(shapes.all.size());
  std::vector<EdgeRange> items;
  for (std::uint32_t b = 0; b < visibility.placed.size(); ++b) {
    if (!visibility.placed[b].shares_self_occlusion || known[shapes.of[b]]) continue;
    known[shapes.of[b]] = true;
    const auto edges = static_cast<std::uint32_t>(visibility.placed[b].shape->edges.size());
    parallel::cut_evenly(edges, kEdgesPerItem, [&](std::uint32_t first, std::uint32_t last) {
      items.push_back({.body = b, .first = first, .last = last});
    });
  }
  return items;
}

Result<VisibilityScene> make_visibility_scene(const ViewJob& job,
                                              const parallel::Context& context) {
  VisibilityScene visibility(job);
  if (job.view.perspective) visibility.perspective_map.emplace(job.view, nearest_depth(job));
  if (const Status status = project_shapes(visibility, context); !status) return status.error();
  const parallel::StageTimer timer(context.report,
                                   job.options.stage == Stage::global ? kGlobalStep : kLocalStep);
  if (const Status status = place_bodies(visibility, context); !status) return status.error();
  if (job.options.culling && job.options.stage != Stage::none && !visibility.perspective_map)
    mark_shared_self_occlusion(visibility);
  if (const Status status = make_occlusion_buffer(visibility, context); !status)
    return status.error();
  make_items(visibility);
  return visibility;
}

using geometry::Int128;
using geometry::Vec3l;

namespace {

/// Cuts [lo, hi] down to where an affine function, known at 0 and 1, is not negative.
bool clip_affine(Int128 at_a, Int128 at_b, RationalParam& lo, RationalParam& hi) {
  if (at_a >= 0 && at_b >= 0) return true;
  if (at_a <= 0 && at_b <= 0) return false;
  if (at_a < at_b) {
    const RationalParam root = RationalParam::of(-at_a, at_b - at_a);
    if (less(lo, root)) lo = root;
  } else {
    const RationalParam root = RationalParam::of(at_a, at_a - at_b);
    if (less(root, hi)) hi = root;
  }
  return less(lo, hi);
}

}  // namespace

EdgeQuery::EdgeQuery(const VisibilityScene& visibility, std::uint32_t body_index,
                     const ProjectedEdge& e)
    : body(body_index),
      own(&visibility.placed[body_index]),
      other(own),
      feature(&e),
      kind(e.edge.kind),
      projecting(e.edge.projecting),
      cut_away(e.edge.cut_away),
      contact(own->contact),
      a(e.edge.a.as<std::int64_t>() + own->offset),
      b(e.edge.b.as<std::int64_t>() + own->offset),
      va(e.a + own->at),
      vb(e.b + own->at) {}

EdgeQuery::EdgeQuery(const VisibilityScene& visibility, const Line& line)
    : body(line.body_a),
      own(&visibility.placed[line.body_a]),
      other(&visibility.placed[line.body_b]),
      kind(line.kind),
      cut_away(line.cut_away),
      contact(std::max({own->contact, other->contact, visibility.job.lines.contact})),
      a(line.a - visibility.job.origin),
      b(line.b - visibility.job.origin),
      va(visibility.perspective_map ? ViewPoint{} : visibility.projection(a)),
      vb(visibility.perspective_map ? ViewPoint{} : visibility.projection(b)) {
  projecting = visibility.job.viewer.sees_as_point(a, b);
}

Vec3l EdgeQuery::at(const RationalParam& t, const Vec3l& origin) const {
  if (t.num == 0) return a + origin;
  if (t.num == t.den) return b + origin;
  Vec3l p = a + origin;
  for (int k = 0; k < 3; ++k)
    if (a[k] != b[k]) p[k] += rounded_offset(b[k] - a[k], t);
  return p;
}

bool EdgeQuery::clip(const geometry::Box3l& limits, RationalParam& lo, RationalParam& hi) const {
  for (int k = 0; k < 3; ++k)
    if (!clip_affine(a[k] - limits.lo[k], b[k] - limits.lo[k], lo, hi) ||
        !clip_affine(limits.hi[k] - a[k], limits.hi[k] - b[k], lo, hi))
      return false;
  return true;
}

bool EdgeQuery::clip(std::span<const HalfSpace> window, RationalParam& lo,
                     RationalParam& hi) const {
  for (const HalfSpace& half : window) {
    const ExactNormal n{half.normal.x, half.normal.y, half.normal.z};
    if (!clip_affine(along(n, a) - half.least, along(n, b) - half.least, lo, hi)) return false;
  }
  return true;
}

}  // namespace strake::hlr
