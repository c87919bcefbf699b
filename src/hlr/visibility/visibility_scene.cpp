// SPDX-License-Identifier: Apache-2.0
// Building the scene that the solvers query, and edge queries.
#include "hlr/visibility/visibility_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "hlr/edges/element_loop.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/hlr/steps.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/count_fill.hpp"
#include "strake/parallel/deal.hpp"
#include "strake/parallel/distinct.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/lowest.hpp"
#include "strake/parallel/marks.hpp"
#include "strake/parallel/pieces.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/report.hpp"
#include "strake/parallel/slots.hpp"

namespace strake::hlr {
namespace {

using geometry::Box3l;

// Only shares the work out: between 8 and 128 no difference can be seen (decision 0073).
constexpr std::uint32_t kEdgesPerItem = 32;
constexpr std::size_t kBodiesPerItem = 1024;
/// For the occlusion buffer: with more tiles painting them costs more than it saves. With so many,
/// 0.4 faces are tested per edge of 20,000 boxes about 100 deep, 3 to 6 in a ship (docs/hlr.md).
constexpr std::size_t kEdgesPerTile = 16;

bool within(const Box3l& inner, const Box3l& outer) {
  for (int k = 0; k < 3; ++k)
    if (inner.lo[k] < outer.lo[k] || inner.hi[k] > outer.hi[k]) return false;
  return true;
}

/// Returns about the least distance before the eye of what is drawn, regardless of the near plane.
Result<double> nearest_depth(const ViewJob& job, const parallel::Context& context) {
  const ViewAxes axes = axes_of(job.view);
  const auto nearest = parallel::reduce(
      context,
      {.name = "hidden lines: nearest body",
       .n = job.scene->bodies.size(),
       .grain = kBodiesPerItem},
      std::numeric_limits<double>::infinity(),
      [&](double& least, std::size_t b) {
        const model::GridBody& body = job.scene->bodies[b];
        const geometry::Box3i& box = job.scene->shapes[body.grid_shape].box;
        if (!job.drawn[model::index(body.object)] || box.empty()) return;
        for (int corner = 0; corner < 8; ++corner) {
          geometry::Vec3l p = job.offset(body);
          for (int k = 0; k < 3; ++k) p[k] += (corner >> k & 1) != 0 ? box.hi[k] : box.lo[k];
          least = std::min(least, -dot(axes.toward, p.as<double>()));
        }
      },
      [](double& into, double least) { into = std::min(into, least); });
  if (!nearest) return nearest;
  const double near_plane = job.view.perspective->near_mm * geometry::kGridPerMm;
  return std::isfinite(*nearest) ? std::max(*nearest, near_plane) : near_plane;
}

/// Returns whether all of a box lies beyond one of some half-spaces.
bool is_beyond(std::span<const HalfSpace> sides, const Box3l& box) {
  return std::ranges::any_of(sides, [&](const HalfSpace& side) {
    geometry::Vec3l deepest;
    for (int k = 0; k < 3; ++k) deepest[k] = side.normal[k] > 0 ? box.hi[k] : box.lo[k];
    return along({side.normal.x, side.normal.y, side.normal.z}, deepest) < side.least;
  });
}

/// Finds what limits, frustum and sections leave of a body; decision 0127 says what for.
void compare_with_view(const ViewJob& job, std::uint32_t b, BodyInstance& placed) {
  const SectionedShape& sectioned = job.sectioned_shape_of(b);
  placed.outside = sectioned.away;
  placed.opaque = placed.opaque && !sectioned.away;
  if ((!job.limits && job.window.empty()) || sectioned.shape().box.empty()) return;
  Box3l box = job.scene->bodies[b].box(sectioned.shape());
  // Hatch lines lie on the plane itself, and rounded rims up to 1.5 units off it.
  const std::int64_t beyond = sectioned.cut != nullptr ? 2 : 0;
  const geometry::Vec3l more{beyond, beyond, beyond};
  box = {box.lo - job.origin - more, box.hi - job.origin + more};
  if (job.limits) {
    placed.cut = !within(box, *job.limits);
    const bool beside = !box.meets(*job.limits);
    placed.outside = placed.outside || beside;
    placed.opaque = placed.opaque && !beside;
  }
  if (job.window.empty()) return;
  // Beside the frustum, whose sides pass through the eye, nothing hides what is in it. What the
  // near plane leaves out hides.
  const std::span<const HalfSpace> window(job.window);
  const bool beside = is_beyond(window.subspan(1), box);
  placed.outside = placed.outside || beside || is_beyond(window.first(1), box);
  placed.opaque = placed.opaque && !beside;
}

/// Returns a body as it is placed, without its shape.
BodyInstance placed_body(const VisibilityScene& visibility, std::uint32_t b) {
  const ViewJob& job = visibility.job;
  const model::GridBody& body = job.scene->bodies[b];
  BodyInstance placed;
  placed.offset = job.offset(body);
  if (!visibility.perspective_map) placed.at = visibility.projection(placed.offset);
  placed.object = model::index(body.object);
  placed.contact = job.contact[b];
  placed.within = job.sectioned_shape_of(b).within;
  placed.opaque = job.opaque[b];
  placed.forgives_rounding = job.forgives_rounding(b);
  compare_with_view(job, b, placed);
  return placed;
}

/// Which of the shapes are requested, each by the first body that is drawn with it, and which hide.
struct RequestedShapes {
  explicit RequestedShapes(std::size_t shapes) : body_of(shapes), hiding(shapes) {}
  parallel::Lowest body_of;
  parallel::Marks hiding;
};

/// Places the bodies that are drawn; their shapes come later.
Status place_bodies(VisibilityScene& visibility, RequestedShapes& requested,
                    const parallel::Context& context) {
  const ViewJob& job = visibility.job;
  const model::Scene& scene = *job.scene;
  auto placed_bodies = parallel::unset_slots<BodyInstance>(scene.bodies.size(), context);
  if (!placed_bodies) return placed_bodies.error();
  visibility.placed = std::move(*placed_bodies);
  return parallel::for_each(
      context, {.name = "hidden lines: bodies", .n = scene.bodies.size(), .grain = kBodiesPerItem},
      [&](std::size_t index) {
        const auto b = static_cast<std::uint32_t>(index);
        visibility.placed[b] = {};
        const std::uint32_t object = model::index(scene.bodies[b].object);
        if (!job.drawn[object]) return;
        visibility.placed[b] = placed_body(visibility, b);
        const std::uint32_t shape = visibility.shape_number(b);
        requested.body_of.offer(shape, b);
        if (visibility.placed[b].opaque) requested.hiding.set(shape);
      });
}

/// Projects each shape for all bodies that share it; in perspective, for each body.
Status project_shapes(VisibilityScene& visibility, const RequestedShapes& requested,
                      const parallel::Context& context) {
  const ViewJob& job = visibility.job;
  const model::Scene& scene = *job.scene;
  const parallel::Lowest& body_of = requested.body_of;
  std::vector<std::uint32_t> wanted;
  for (std::uint32_t shape = 0; shape < body_of.size(); ++shape)
    if (body_of[shape] != parallel::Lowest::kNone) wanted.push_back(shape);
  const auto edges = [&](std::size_t shape) {
    std::size_t sum = 0;
    for (const geometry::Part& part : job.sectioned_shape_of(body_of[shape]).source->parts)
      sum += part.edges.size();
    return sum;
  };
  visibility.shapes = parallel::Precomputed<ProjectedShape>(body_of.size());
  const PerspectiveMap* const perspective_map =
      visibility.perspective_map ? &*visibility.perspective_map : nullptr;
  return visibility.shapes.fill_by_weight(
      context, {.name = "hidden lines: shapes"}, kBigShape, wanted, edges, [&](std::size_t shape) {
        const std::uint32_t body = body_of[shape];
        return project_shape(job.sectioned_shape_of(body),
                             {.projection = visibility.projection,
                              .features = job.features_of(scene.bodies[body]),
                              .perspective_map = perspective_map,
                              .bucketing = job.options.bucketing,
                              .find_edge_on = job.may_forgive_rounding(),
                              .hides = requested.hiding.is_set(shape),
                              .context = context});
      });
}

/// Places the bodies and projects their shapes, once for all bodies that share one.
Status make_bodies(VisibilityScene& visibility, const parallel::Context& context) {
  const parallel::StageTimer timer(context.report, kLocalStep);
  RequestedShapes requested(visibility.perspective_map ? visibility.job.scene->bodies.size()
                                                       : visibility.job.sectioned.all.size());
  if (const Status status = place_bodies(visibility, requested, context); !status) return status;
  return project_shapes(visibility, requested, context);
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
  const auto hiding = parallel::collect<std::uint32_t>(
      context, {.name = "hidden lines: hiding bodies", .n = boxes.size(), .grain = kBodiesPerItem},
      [&](std::size_t b, std::vector<std::uint32_t>& out) {
        if (!boxes[b].empty()) out.push_back(static_cast<std::uint32_t>(b));
      });
  if (!hiding) return hiding.error();
  const std::vector<std::uint32_t>& some = *hiding;
  const auto found = find_columns(visibility, some, context);
  if (!found) return found.error();
  BodyColumns& columns = visibility.columns;
  const std::size_t count = found->first.size();
  auto by_column =
      parallel::items_by_key(context, "hidden lines: bodies of columns", some.size(), count,
                             [&](std::size_t i) { return std::size_t{found->of[i]}; });
  if (!by_column) return by_column.error();
  std::vector<ViewBox> nearest(count);
  const auto column = [&](std::size_t c) {
    const std::vector<std::size_t>& at = by_column->offsets;
    return std::span(by_column->values).subspan(at[c], at[c + 1] - at[c]);
  };
  const auto stays = [&](std::uint32_t b) { return !visibility.placed[b].repeated; };
  auto kept = parallel::count_fill<std::uint32_t>(
      context, {.name = "hidden lines: columns", .n = count, .grain = kBodiesPerItem},
      [&](std::size_t c) {
        for (std::uint32_t& b : column(c)) b = some[b];
        std::ranges::sort(column(c), [&](std::uint32_t x, std::uint32_t y) {
          const std::int64_t at_x = visibility.placed[x].at.w, at_y = visibility.placed[y].at.w;
          return at_x != at_y ? at_x > at_y : x < y;
        });
        nearest[c] = boxes[column(c).front()];
        if (visibility.job.options.culling) mark_repeated(visibility, column(c));
        return static_cast<std::size_t>(std::ranges::count_if(column(c), stays));
      },
      [&](std::size_t c, std::span<std::uint32_t> out) {
        std::ranges::copy_if(column(c), out.begin(), stays);
      });
  if (!kept) return kept.error();
  columns.bodies = std::move(kept->values);
  columns.first.assign(kept->offsets.begin(), kept->offsets.end());
  auto tree = ViewBvh::of(nearest, context);
  if (!tree) return tree.error();
  visibility.tree = std::move(*tree);
  return {};
}

/// Gives bodies their projected shapes, and puts those that may hide into columns.
Status shape_bodies(VisibilityScene& visibility, const parallel::Context& context) {
  const ViewJob& job = visibility.job;
  auto made = parallel::unset_slots<ViewBox>(visibility.placed.size(), context);
  if (!made) return made.error();
  std::vector<ViewBox>& boxes = *made;
  Status status = parallel::for_each(
      context,
      {.name = "hidden lines: shapes of bodies", .n = boxes.size(), .grain = kBodiesPerItem},
      [&](std::size_t b) {
        boxes[b] = {};
        BodyInstance& placed = visibility.placed[b];
        if (!job.drawn[model::index(job.scene->bodies[b].object)]) return;
        placed.shape =
            visibility.shapes.find(visibility.shape_number(static_cast<std::uint32_t>(b)));
        if (placed.opaque && !placed.shape->box.empty())
          boxes[b] = placed.shape->box.moved(placed.at);
      });
  if (!status) return status;
  return make_columns(visibility, boxes, context);
}

/// Marks whole bodies of one shape that hide and have the same contact distance between their
/// parts.
Status mark_shared_self_occlusion(VisibilityScene& visibility, const parallel::Context& context) {
  const SectionedShapes& shapes = visibility.job.sectioned;
  parallel::Lowest first(shapes.all.size());
  parallel::Marks shared(shapes.all.size());
  const auto may_share = [&](const BodyInstance& placed) {
    return placed.shape != nullptr && placed.opaque && !placed.cut &&
           visibility.job.solves(placed.object);
  };
  const parallel::Region bodies{.name = "hidden lines: bodies of a shape",
                                .n = visibility.placed.size(),
                                .grain = kBodiesPerItem};
  Status status = parallel::for_each(context, bodies, [&](std::size_t b) {
    if (may_share(visibility.placed[b])) first.offer(shapes.of[b], b);
  });
  if (!status) return status;
  // The first body of a shape shares with any other, which is not to write to it.
  const auto others = parallel::reduce(
      context, bodies, std::uint64_t{0},
      [&](std::uint64_t& count, std::size_t b) {
        BodyInstance& placed = visibility.placed[b];
        const std::uint32_t one = first[shapes.of[b]];
        if (one == b || !may_share(placed) || placed.contact != visibility.placed[one].contact)
          return;
        placed.shares_self_occlusion = true;
        shared.set(shapes.of[b]);
        ++count;
      },
      [](std::uint64_t& into, std::uint64_t count) { into += count; });
  if (!others) return others.error();
  for (std::size_t s = 0; s < first.size(); ++s)
    if (shared.is_set(s)) visibility.first_sharing.push_back(first[s]);
  std::ranges::sort(visibility.first_sharing);
  for (const std::uint32_t b : visibility.first_sharing)
    visibility.placed[b].shares_self_occlusion = true;
  visibility.sharing = *others + visibility.first_sharing.size();
  return {};
}

Status make_occlusion_buffer(VisibilityScene& visibility, const parallel::Context& context) {
  const ViewJob& job = visibility.job;
  if (!job.options.culling || job.options.stage != Stage::global || visibility.perspective_map)
    return {};
  const auto edges = parallel::reduce(
      context,
      {.name = "hidden lines: number of edges",
       .n = visibility.placed.size(),
       .grain = kBodiesPerItem},
      std::size_t{0},
      [&](std::size_t& sum, std::size_t b) {
        const BodyInstance& placed = visibility.placed[b];
        if (placed.shape != nullptr) sum += placed.shape->edges.size();
      },
      [](std::size_t& into, std::size_t sum) { into += sum; });
  if (!edges) return edges.error();
  std::int64_t contact = job.lines.contact;
  for (const std::int64_t c : job.contact) contact = std::max(contact, c);
  auto occlusion_buffer = OcclusionBuffer::of(visibility.placed, visibility.projection, contact,
                                              *edges / kEdgesPerTile, context);
  if (!occlusion_buffer) return occlusion_buffer.error();
  visibility.occlusion_buffer = std::move(*occlusion_buffer);
  return {};
}

/// Appends the work items of an object. Returns how many of its edges are in none: see
/// VisibilityScene::outside.
std::uint32_t append_items(const VisibilityScene& visibility, std::uint32_t object,
                           std::vector<EdgeRange>& items) {
  const std::vector<std::uint32_t>& first_body = visibility.job.scene->first_body;
  if (!visibility.job.solves(object)) return 0;
  const std::size_t first_item = items.size();
  std::uint32_t number = 0, outside = 0;
  const auto add = [&](std::uint32_t body, std::size_t size, bool lines) {
    const auto edges = static_cast<std::uint32_t>(size);
    parallel::cut_evenly(edges, kEdgesPerItem, [&](std::uint32_t first, std::uint32_t last) {
      items.push_back({body, first, last, number + first, lines});
    });
    number += edges;
  };
  for (std::uint32_t b = first_body[object]; b < first_body[object + 1]; ++b) {
    const BodyInstance& placed = visibility.placed[b];
    if (placed.shape == nullptr) continue;
    const auto edges = static_cast<std::uint32_t>(placed.shape->edges.size());
    if (visibility.leaves_out(placed)) {
      outside += edges;
      number += edges;
    } else {
      add(b, edges, false);
    }
    if (b + 1 != first_body[object + 1]) continue;
    add(b, visibility.job.lines.of(object).size(), true);
    if (items.size() == first_item + 1) items.back().whole = !items.back().lines && outside == 0;
  }
  return outside;
}

Status make_items(VisibilityScene& visibility, const parallel::Context& context) {
  const ViewJob& job = visibility.job;
  if (!job.options.clipped) {
    auto outside = parallel::slots<std::uint32_t>(job.drawn.size(), context);
    if (!outside) return outside.error();
    visibility.outside = std::move(*outside);
  }
  auto items = parallel::collect<EdgeRange>(
      context, {.name = "hidden lines: work items", .n = job.drawn.size(), .grain = kBodiesPerItem},
      [&](std::size_t object, std::vector<EdgeRange>& out) {
        const std::uint32_t outside =
            append_items(visibility, static_cast<std::uint32_t>(object), out);
        if (outside > 0) visibility.outside[object] = outside;
      });
  if (!items) return items.error();
  visibility.items = std::move(*items);
  return {};
}

}  // namespace

std::vector<EdgeRange> self_occlusion_ranges(const VisibilityScene& visibility) {
  std::vector<EdgeRange> items;
  for (const std::uint32_t b : visibility.first_sharing) {
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
  if (job.view.perspective) {
    const Result<double> nearest = nearest_depth(job, context);
    if (!nearest) return nearest.error();
    visibility.perspective_map.emplace(job.view, *nearest);
  }
  if (const Status status = make_bodies(visibility, context); !status) return status.error();
  const parallel::StageTimer timer(context.report,
                                   job.options.stage == Stage::global ? kGlobalStep : kLocalStep);
  if (const Status status = shape_bodies(visibility, context); !status) return status.error();
  if (job.options.culling && job.options.stage != Stage::none && !visibility.perspective_map)
    if (const Status status = mark_shared_self_occlusion(visibility, context); !status)
      return status.error();
  if (const Status status = make_occlusion_buffer(visibility, context); !status)
    return status.error();
  if (const Status status = make_items(visibility, context); !status) return status.error();
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
  projecting = visibility.job.viewer.projects_to_point(a, b);
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
