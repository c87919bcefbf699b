// SPDX-License-Identifier: Apache-2.0
// Building occluder polygons: by group of triangles, and for a whole part.
#include "hlr/occluders/occluder_polygons.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numeric>
#include <utility>
#include <vector>

#include "core/union_find.hpp"
#include "hlr/edges/edge_on.hpp"
#include "hlr/edges/element_loop.hpp"
#include "hlr/edges/feature_edges.hpp"
#include "hlr/occluders/occluder_index.hpp"
#include "hlr/occluders/projected_shape.hpp"
#include "hlr/occluders/silhouette_loops.hpp"
#include "strake/geometry/part.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/slots.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::hlr {

using geometry::Triangle;

namespace {

/// The first big part of a shape gets its memory from the team; more of them grow it geometrically,
/// so that many do not copy all of it for each.
template <class T>
Status extend(std::vector<T>& values, std::size_t size, const parallel::Context& context) {
  if (!values.empty()) {
    values.resize(size);
    return {};
  }
  auto all = parallel::slots<T>(size, context);
  if (!all) return all.error();
  values = std::move(*all);
  return {};
}

}  // namespace

void OccluderBuilder::add_group(std::span<const std::uint32_t> triangles, OccluderPolygons& out) {
  if (loops_.find_outline(triangles)) {
    add_found(triangles[0], out);
    return;
  }
  for (const std::uint32_t t : triangles) {
    loops_.take_triangle(t);
    add_found(t, out);
  }
}

void OccluderBuilder::add_wide(std::uint32_t t, OccluderPolygons& out) {
  ExactNormal n = triangle_normal(projected_.part, t);
  Triangle i = projected_.part.triangles[t];
  const Int128 facing =
      projected_.viewer.facing(n, projected_.part.vertices[i[0]].as<std::int64_t>());
  if (facing == 0) return;
  if (facing < 0) {
    for (Int128& x : n) x = -x;
    std::swap(i[1], i[2]);
  }
  OccluderPolygon& p = start(i[0], out);
  p.wide = static_cast<std::int32_t>(out.wide_normals.size());
  p.back = facing < 0;
  p.edge_on =
      projected_.find_edge_on && may_be_edge_on(projected_.part, t, projected_.viewer.direction);
  out.wide_normals.push_back(n);
  add_corners(p, i, out);
}

bool OccluderBuilder::make_outline(OccluderPolygon& outline, OccluderPolygons& out) {
  if (!loops_.find_silhouette()) return false;
  outline.part = part_index_;
  add_corners(outline, loops_.found(), out);
  return true;
}

OccluderPolygon& OccluderBuilder::start(std::uint32_t vertex, OccluderPolygons& out) const {
  OccluderPolygon& p = out.polygons.emplace_back();
  p.at = projected_.part.vertices[vertex];
  p.part = part_index_;
  return p;
}

void OccluderBuilder::add_found(std::uint32_t t, OccluderPolygons& out) {
  OccluderPolygon& p = start(loops_.found()[0], out);
  p.normal = projected_.towards_viewer(t);
  p.edge_on = projected_.planes[t].edge_on;
  p.back = projected_.planes[t].facing < 0;
  add_corners(p, loops_.found(), out);
}

void OccluderBuilder::add_corners(OccluderPolygon& p, std::span<const std::uint32_t> vertices,
                                  OccluderPolygons& out) const {
  p.corners = static_cast<std::uint32_t>(vertices.size());
  if (projected_.viewer.eye) {
    p.first_corner = static_cast<std::uint32_t>(out.rays.size());
    for (const std::uint32_t v : vertices) out.rays.push_back(projected_.rays[v]);
    p.box = perspective_map_->box_of(std::span(out.rays).last(vertices.size()));
    return;
  }
  p.first_corner = static_cast<std::uint32_t>(out.corners.size());
  for (const std::uint32_t v : vertices) {
    p.box.include(projected_.points[v]);
    out.corners.push_back({projected_.points[v].u, projected_.points[v].v});
  }
}

Status append(OccluderPolygons& all, std::span<const OccluderPolygons> runs,
              const parallel::Context& context) {
  struct Start {
    std::size_t polygon = 0, corner = 0, ray = 0;
  };
  std::vector<Start> starts;
  Start next{all.polygons.size(), all.corners.size(), all.rays.size()};
  for (const OccluderPolygons& run : runs) {
    starts.push_back(next);
    next.polygon += run.polygons.size();
    next.corner += run.corners.size();
    next.ray += run.rays.size();
  }
  if (const Status s = extend(all.polygons, next.polygon, context); !s) return s;
  if (const Status s = extend(all.corners, next.corner, context); !s) return s;
  if (const Status s = extend(all.rays, next.ray, context); !s) return s;
  return parallel::for_each(
      context, {.name = "hidden lines: polygons put together", .n = runs.size()},
      [&](std::size_t r) {
        const auto at = [](auto& values, std::size_t i) {
          return values.begin() + static_cast<std::ptrdiff_t>(i);
        };
        const std::size_t corner = runs[r].rays.empty() ? starts[r].corner : starts[r].ray;
        auto to = at(all.polygons, starts[r].polygon);
        for (OccluderPolygon p : runs[r].polygons) {
          p.first_corner += static_cast<std::uint32_t>(corner);
          *to++ = p;
        }
        std::ranges::copy(runs[r].corners, at(all.corners, starts[r].corner));
        std::ranges::copy(runs[r].rays, at(all.rays, starts[r].ray));
      });
}

}  // namespace strake::hlr

// Merges exactly coplanar triangles into convex polygons.

namespace strake::hlr {
namespace {

using geometry::has_directed_edge;
using geometry::opposite_vertex;
using geometry::Part;
using geometry::Vec3i;
using geometry::Vec3l;

// Parts up to this size have normals of 62 bits.
constexpr std::int64_t kNarrow = std::int64_t{1} << 30;

// Returns n · (p - q).
Int128 height(const std::array<std::int64_t, 3>& n, const Vec3i& p, const Vec3i& q) {
  return static_cast<Int128>(n[0]) * (std::int64_t{p.x} - q.x) +
         static_cast<Int128>(n[1]) * (std::int64_t{p.y} - q.y) +
         static_cast<Int128>(n[2]) * (std::int64_t{p.z} - q.z);
}

/// How the triangles at an edge lie to each other.
enum class Bend : std::uint8_t {
  convex,
  not_convex,  ///< concave, or not two triangles that run through it both ways
  folded,      ///< they lie upon each other
  flat,
};

class PartMerger {
 public:
  PartMerger(const Part& part, std::uint32_t part_index, const ProjectionSettings& settings,
             std::span<const ProjectedEdge> edges, ProjectedShape& shape)
      : part_(part),
        part_index_(part_index),
        settings_(settings),
        viewer_(settings.features.viewer),
        edges_(edges),
        shape_(shape),
        projected_{.part = part,
                   .viewer = settings.features.viewer,
                   .find_edge_on = settings.find_edge_on} {}

  Result<bool> run() {
    first_ = static_cast<std::uint32_t>(shape_.polygons.size());
    if (const Status s = projected_.project(settings_.projection, settings_.context); !s)
      return s.error();
    OccluderBuilder maker(projected_, part_index_, settings_.perspective_map);
    if (!narrow()) {
      for (std::uint32_t t = 0; t < part_.triangles.size(); ++t) maker.add_wide(t, shape_);
      return finish({}, false);
    }
    if (const Status s = projected_.find_planes(settings_.context); !s) return s.error();
    const Result<bool> locally_convex = traverse_edges();
    if (!locally_convex) return locally_convex.error();
    const bool convex = *locally_convex && bounds_convex_body(part_, projected_.planes);
    if (const Status s = add_groups(maker); !s) return s.error();
    OccluderPart part;
    if (convex) part.has_outline = maker.make_outline(part.outline, shape_);
    return finish(std::move(part), convex);
  }

 private:
  [[nodiscard]] bool narrow() const {
    const auto lo = part_.box.lo.as<std::int64_t>(), hi = part_.box.hi.as<std::int64_t>();
    return hi.x - lo.x <= kNarrow && hi.y - lo.y <= kNarrow && hi.z - lo.z <= kNarrow;
  }

  Result<bool> finish(OccluderPart part, bool convex) {
    part.first = first_;
    part.last = static_cast<std::uint32_t>(shape_.polygons.size());
    if (part.first == part.last) return convex;
    const auto polygons = std::span(shape_.polygons).subspan(first_);
    struct Extent {
      ViewBox box;
      double steepest = 0;
    };
    const bool needs_slopes = !viewer_.eye || part.has_outline;
    const Result<Extent> extent = parallel::reduce(
        settings_.context, over_elements("hidden lines: extent of a part", polygons.size()),
        Extent{},
        [&](Extent& all, std::size_t i) {
          all.box.include(polygons[i].box);
          if (needs_slopes) all.steepest = std::max(all.steepest, steepness(polygons[i]));
        },
        [](Extent& all, const Extent& more) {
          all.box.include(more.box);
          all.steepest = std::max(all.steepest, more.steepest);
        });
    if (!extent) return extent.error();
    part.box = extent->box;
    part.outline.box = part.box;
    part.farthest = projected_.farthest();
    // Rounding of the few operations is far below the fraction added.
    if (needs_slopes) part.deep_per_contact = extent->steepest * reach() * (1 + 1e-9);
    part.edge_on = std::ranges::any_of(polygons, &OccluderPolygon::edge_on);
    if (const Status s = build_occluder_index(shape_, edges_, hubs(), convex, settings_, part); !s)
      return s.error();
    shape_.parts.push_back(std::move(part));
    return convex;
  }

  /// Returns the points on paper where many triangles meet.
  [[nodiscard]] std::vector<PaperCorner> hubs() const {
    std::vector<PaperCorner> hubs;
    if (viewer_.eye || part_.triangles.size() < kMinInFan) return hubs;
    std::vector<std::uint32_t> round(part_.vertices.size(), 0);
    for (const geometry::Triangle& t : part_.triangles)
      for (const std::uint32_t v : t) ++round[v];
    for (std::size_t v = 0; v < round.size(); ++v) {
      if (round[v] < kMinInFan) continue;
      const ViewPoint p = settings_.projection(part_.vertices[v].as<std::int64_t>());
      hubs.push_back({p.u, p.v});
    }
    return hubs;
  }

  [[nodiscard]] Bend bend_at(std::size_t k) const {
    const geometry::PartEdge& e = part_.edges[k];
    if (part_.edges[k + 1].first_triangle - e.first_triangle != 2) return Bend::not_convex;
    const std::uint32_t s = part_.edge_triangles[e.first_triangle];
    const std::uint32_t t = part_.edge_triangles[e.first_triangle + 1];
    if (has_directed_edge(part_.triangles[s], e.v0, e.v1) ==
        has_directed_edge(part_.triangles[t], e.v0, e.v1))
      return Bend::not_convex;
    const Int128 bend =
        height(projected_.planes[s].n, part_.vertices[opposite_vertex(part_.triangles[t], e)],
               part_.vertices[e.v0]);
    if (bend != 0) return bend > 0 ? Bend::not_convex : Bend::convex;
    return is_folded(s, t) ? Bend::folded : Bend::flat;
  }

  // Groups coplanar neighbours; true when every edge is manifold, consistent and not concave.
  Result<bool> traverse_edges() {
    const std::size_t edges = part_.edges.empty() ? 0 : part_.edges.size() - 1;
    std::vector<Bend> bends(edges);
    const Status status =
        parallel::for_each(settings_.context, over_elements("hidden lines: bends", edges),
                           [&](std::size_t k) { bends[k] = bend_at(k); });
    if (!status) return status.error();
    UnionFind groups(part_.triangles.size());
    bool convex = part_.kind == geometry::PartKind::solid && part_.shell_count == 1;
    for (std::size_t k = 0; k < edges; ++k) {
      convex = convex && bends[k] != Bend::not_convex && bends[k] != Bend::folded;
      if (bends[k] != Bend::flat) continue;
      const std::uint32_t first = part_.edges[k].first_triangle;
      const std::uint32_t s = part_.edge_triangles[first], t = part_.edge_triangles[first + 1];
      if (projected_.planes[s].edge_on == projected_.planes[t].edge_on) groups.join(s, t);
    }
    group_.resize(part_.triangles.size());
    for (std::uint32_t t = 0; t < group_.size(); ++t) group_[t] = groups.root(t);
    return convex;
  }

  // Returns whether two coplanar triangles lie upon each other.
  [[nodiscard]] bool is_folded(std::uint32_t s, std::uint32_t t) const {
    const auto &m = projected_.planes[s].n, &n = projected_.planes[t].n;
    for (std::size_t k = 0; k < 3; ++k)
      if (m[k] != 0) return (m[k] > 0) != (n[k] > 0);
    return true;
  }

  // Returns |n|_1 / facing of a polygon's normal.
  [[nodiscard]] double steepness(const OccluderPolygon& p) const {
    const ExactNormal n = shape_.normal(p);
    double sum = 0;
    for (const Int128& x : n) sum += std::abs(static_cast<double>(x));
    return sum / static_cast<double>(viewer_.facing(n, p.at.as<std::int64_t>()));
  }

  // Per contact distance, a point must lie deeper along the direction than the point of a face that
  // hides it by this times |n|_1 / facing. In perspective the distance between the two grows with
  // that from the eye.
  [[nodiscard]] double reach() const {
    const auto d = viewer_.direction.as<double>();
    if (!viewer_.eye) return dot(d, d);
    double farthest = 0;
    for (const Vec3l& r : projected_.rays)
      farthest = std::max(farthest, dot(r.as<double>(), r.as<double>()));
    return std::sqrt(dot(d, d) * farthest);
  }

  // Returns the triangles that are not seen edge-on, group by group and in their order. It is a
  // counting sort: a group is the number of its first triangle.
  [[nodiscard]] Result<std::vector<std::uint32_t>> in_groups() const {
    std::vector<std::uint8_t> shows(group_.size());
    const Status status = parallel::for_each(
        settings_.context, over_elements("hidden lines: faces that show", shows.size()),
        [&](std::size_t t) { shows[t] = projected_.planes[t].facing != 0 ? 1 : 0; });
    if (!status) return status.error();
    std::vector<std::uint32_t> next(group_.size() + 1, 0);
    for (std::uint32_t t = 0; t < group_.size(); ++t) next[group_[t] + 1] += shows[t];
    std::partial_sum(next.begin(), next.end(), next.begin());
    std::vector<std::uint32_t> order(next.back());
    for (std::uint32_t t = 0; t < group_.size(); ++t)
      if (shows[t] != 0) order[next[group_[t]]++] = t;
    return order;
  }

  Status add_groups(OccluderBuilder& maker) {
    const Result<std::vector<std::uint32_t>> found = in_groups();
    if (!found) return found.error();
    const std::vector<std::uint32_t>& order = *found;
    const auto add = [&](OccluderBuilder& own, std::size_t first, std::size_t last,
                         OccluderPolygons& out) {
      for (std::size_t i = first, end = 0; i < last; i = end) {
        end = i + 1;
        while (end < order.size() && group_[order[end]] == group_[order[i]]) ++end;
        own.add_group(std::span(order).subspan(i, end - i), out);
      }
    };
    if (order.size() < kBigShape) {
      add(maker, 0, order.size(), shape_);
      return {};
    }
    // The runs hold whole groups.
    constexpr std::size_t kRun = 4096;
    std::vector<std::size_t> cuts{0};
    for (std::size_t i = kRun; i < order.size(); i += kRun) {
      while (i < order.size() && group_[order[i]] == group_[order[i - 1]]) ++i;
      if (i < order.size()) cuts.push_back(i);
    }
    cuts.push_back(order.size());
    const auto runs = parallel::transform_with(
        settings_.context, {.name = "hidden lines: polygons", .n = cuts.size() - 1},
        [&] { return OccluderBuilder(projected_, part_index_, settings_.perspective_map); },
        [&](OccluderBuilder& own, std::size_t r) {
          OccluderPolygons out;
          add(own, cuts[r], cuts[r + 1], out);
          return out;
        });
    if (!runs) return runs.error();
    return append(shape_, *runs, settings_.context);
  }

  const Part& part_;
  std::uint32_t part_index_;
  std::uint32_t first_ = 0;
  const ProjectionSettings& settings_;
  const Viewer& viewer_;
  std::span<const ProjectedEdge> edges_;
  ProjectedShape& shape_;
  ProjectedPart projected_;
  std::vector<std::uint32_t> group_;
};

}  // namespace

Result<bool> add_polygons(const Part& part, std::uint32_t part_index,
                          const ProjectionSettings& settings, std::span<const ProjectedEdge> edges,
                          ProjectedShape& shape) {
  return PartMerger(part, part_index, settings, edges, shape).run();
}

}  // namespace strake::hlr
