// SPDX-License-Identifier: Apache-2.0
// Merges exactly coplanar triangles into convex polygons.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "hlr/convexity.hpp"
#include "hlr/loops.hpp"
#include "hlr/part_index.hpp"
#include "hlr/polygon_maker.hpp"
#include "hlr/shape_loop.hpp"
#include "hlr/shape_view.hpp"
#include "strake/core/disjoint_sets.hpp"
#include "strake/geometry/part_edges.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::hlr {
namespace {

using geometry::corner_off;
using geometry::Part;
using geometry::runs_along;
using geometry::Vec3i;
using geometry::Vec3l;

// Parts up to this size have normals of 62 bits.
constexpr std::int64_t kNarrow = std::int64_t{1} << 30;

// The sign and value of n · (p - q).
Int128 height(const std::array<std::int64_t, 3>& n, const Vec3i& p, const Vec3i& q) {
  return static_cast<Int128>(n[0]) * (std::int64_t{p.x} - q.x) +
         static_cast<Int128>(n[1]) * (std::int64_t{p.y} - q.y) +
         static_cast<Int128>(n[2]) * (std::int64_t{p.z} - q.z);
}

/// What the triangles at an edge are to each other.
enum class Bend : std::uint8_t {
  convex,
  not_convex,  ///< concave, or not two triangles that run through it both ways
  folded,      ///< they lie upon each other
  flat,
};

class PartMerger {
 public:
  PartMerger(const Part& part, std::uint32_t part_index, const Sight& sight,
             std::span<const EdgeView> edges, ShapeView& view)
      : part_(part),
        part_index_(part_index),
        sight_(sight),
        viewer_(sight.features.viewer),
        edges_(edges),
        view_(view),
        seen_{.part = part, .viewer = sight.features.viewer, .find_edge_on = sight.find_edge_on} {}

  Result<bool> run() {
    first_ = static_cast<std::uint32_t>(view_.polygons.size());
    if (const Status s = seen_.project(sight_.frame, sight_.context); !s) return s.error();
    PolygonMaker maker(seen_, part_index_, sight_.picture);
    if (!narrow()) {
      for (std::uint32_t t = 0; t < part_.triangles.size(); ++t) maker.add_wide(t, view_);
      return finish({}, false);
    }
    if (const Status s = seen_.find_planes(sight_.context); !s) return s.error();
    const Result<bool> locally_convex = walk_edges();
    if (!locally_convex) return locally_convex.error();
    const bool convex = *locally_convex && bounds_convex_body(part_, seen_.planes);
    if (const Status s = add_groups(maker); !s) return s.error();
    PartView part;
    part.farthest = seen_.farthest();
    if (convex) add_outline(maker, part);
    return finish(std::move(part), convex);
  }

 private:
  [[nodiscard]] bool narrow() const {
    const auto lo = part_.box.lo.as<std::int64_t>(), hi = part_.box.hi.as<std::int64_t>();
    return hi.x - lo.x <= kNarrow && hi.y - lo.y <= kNarrow && hi.z - lo.z <= kNarrow;
  }

  Result<bool> finish(PartView part, bool convex) {
    part.first = first_;
    part.last = static_cast<std::uint32_t>(view_.polygons.size());
    if (part.first == part.last) return convex;
    const auto polygons = std::span(view_.polygons).subspan(first_);
    const Result<ViewBox> box = parallel::reduce(
        sight_.context, over_elements("hidden lines: box of a part", polygons.size()), ViewBox{},
        [&](ViewBox& all, std::size_t i) { all.include(polygons[i].box); },
        [](ViewBox& all, const ViewBox& more) { all.include(more); });
    if (!box) return box.error();
    part.box = *box;
    part.outline.box = part.box;
    part.edge_on = std::ranges::any_of(polygons, &Polygon::edge_on);
    if (const Status s = index(view_, edges_, hubs(), convex, sight_, part); !s) return s.error();
    view_.parts.push_back(std::move(part));
    return convex;
  }

  /// Where many triangles meet, on paper.
  [[nodiscard]] std::vector<Corner> hubs() const {
    std::vector<Corner> hubs;
    if (viewer_.eye || part_.triangles.size() < kLeastInFan) return hubs;
    std::vector<std::uint32_t> round(part_.vertices.size(), 0);
    for (const geometry::Triangle& t : part_.triangles)
      for (const std::uint32_t v : t) ++round[v];
    for (std::size_t v = 0; v < round.size(); ++v) {
      if (round[v] < kLeastInFan) continue;
      const ViewPoint p = sight_.frame(part_.vertices[v].as<std::int64_t>());
      hubs.push_back({p.u, p.v});
    }
    return hubs;
  }

  [[nodiscard]] Bend bend_at(std::size_t k) const {
    const geometry::PartEdge& e = part_.edges[k];
    if (part_.edges[k + 1].first_triangle - e.first_triangle != 2) return Bend::not_convex;
    const std::uint32_t s = part_.edge_triangles[e.first_triangle];
    const std::uint32_t t = part_.edge_triangles[e.first_triangle + 1];
    if (runs_along(part_.triangles[s], e.v0, e.v1) == runs_along(part_.triangles[t], e.v0, e.v1))
      return Bend::not_convex;
    const Int128 bend = height(seen_.planes[s].n, part_.vertices[corner_off(part_.triangles[t], e)],
                               part_.vertices[e.v0]);
    if (bend != 0) return bend > 0 ? Bend::not_convex : Bend::convex;
    return is_folded(s, t) ? Bend::folded : Bend::flat;
  }

  // Groups coplanar neighbours; true when every edge is manifold, consistent and not concave.
  Result<bool> walk_edges() {
    const std::size_t edges = part_.edges.empty() ? 0 : part_.edges.size() - 1;
    std::vector<Bend> bends(edges);
    const Status status =
        parallel::for_each(sight_.context, over_elements("hidden lines: bends", edges),
                           [&](std::size_t k) { bends[k] = bend_at(k); });
    if (!status) return status.error();
    DisjointSets groups(part_.triangles.size());
    bool convex = part_.kind == geometry::PartKind::solid && part_.shell_count == 1;
    for (std::size_t k = 0; k < edges; ++k) {
      convex = convex && bends[k] != Bend::not_convex && bends[k] != Bend::folded;
      if (bends[k] != Bend::flat) continue;
      const std::uint32_t first = part_.edges[k].first_triangle;
      const std::uint32_t s = part_.edge_triangles[first], t = part_.edge_triangles[first + 1];
      if (seen_.planes[s].edge_on == seen_.planes[t].edge_on) groups.join(s, t);
    }
    group_.resize(part_.triangles.size());
    for (std::uint32_t t = 0; t < group_.size(); ++t) group_[t] = groups.root(t);
    return convex;
  }

  // Of two coplanar triangles: whether they lie upon each other.
  [[nodiscard]] bool is_folded(std::uint32_t s, std::uint32_t t) const {
    const auto &m = seen_.planes[s].n, &n = seen_.planes[t].n;
    for (std::size_t k = 0; k < 3; ++k)
      if (m[k] != 0) return (m[k] > 0) != (n[k] > 0);
    return true;
  }

  // The outline of a certified convex part, as one polygon.
  void add_outline(PolygonMaker& maker, PartView& part) {
    if (!maker.make_outline(part.outline, view_)) return;
    double steepest = 0;
    for (const Polygon& p : std::span(view_.polygons).subspan(first_)) {
      const geometry::Vec3d n = geometry::Vec3l{p.normal[0], p.normal[1], p.normal[2]}.as<double>();
      const auto facing =
          static_cast<double>(viewer_.facing(view_.normal(p), p.at.as<std::int64_t>()));
      steepest = std::max(steepest, (std::abs(n.x) + std::abs(n.y) + std::abs(n.z)) / facing);
    }
    // Rounding of the few operations above is far below the share added.
    part.deep_per_contact = steepest * reach() * (1 + 1e-9);
    part.has_outline = true;
  }

  // By this times |n|_1 / facing a point must lie deeper along the direction than the point of a
  // face that hides it, per contact distance. In perspective the way between the two is the longer
  // the farther they are from the eye.
  [[nodiscard]] double reach() const {
    const auto d = viewer_.direction.as<double>();
    if (!viewer_.eye) return dot(d, d);
    double farthest = 0;
    for (const Vec3l& r : seen_.rays)
      farthest = std::max(farthest, dot(r.as<double>(), r.as<double>()));
    return std::sqrt(dot(d, d) * farthest);
  }

  // Triangles that are not seen edge-on, group by group and in their order: by counting, a group
  // being the number of its first triangle.
  [[nodiscard]] Result<std::vector<std::uint32_t>> in_groups() const {
    std::vector<std::uint8_t> shows(group_.size());
    const Status status = parallel::for_each(
        sight_.context, over_elements("hidden lines: faces that show", shows.size()),
        [&](std::size_t t) { shows[t] = seen_.planes[t].facing != 0 ? 1 : 0; });
    if (!status) return status.error();
    std::vector<std::uint32_t> next(group_.size() + 1, 0);
    for (std::uint32_t t = 0; t < group_.size(); ++t) next[group_[t] + 1] += shows[t];
    std::partial_sum(next.begin(), next.end(), next.begin());
    std::vector<std::uint32_t> order(next.back());
    for (std::uint32_t t = 0; t < group_.size(); ++t)
      if (shows[t] != 0) order[next[group_[t]]++] = t;
    return order;
  }

  Status add_groups(PolygonMaker& maker) {
    const Result<std::vector<std::uint32_t>> found = in_groups();
    if (!found) return found.error();
    const std::vector<std::uint32_t>& order = *found;
    const auto add = [&](PolygonMaker& own, std::size_t first, std::size_t last, Polygons& out) {
      for (std::size_t i = first, end = 0; i < last; i = end) {
        end = i + 1;
        while (end < order.size() && group_[order[end]] == group_[order[i]]) ++end;
        own.add_group(std::span(order).subspan(i, end - i), out);
      }
    };
    if (order.size() < kBigShape) {
      add(maker, 0, order.size(), view_);
      return {};
    }
    // Runs of whole groups.
    constexpr std::size_t kRun = 4096;
    std::vector<std::size_t> cuts{0};
    for (std::size_t i = kRun; i < order.size(); i += kRun) {
      while (i < order.size() && group_[order[i]] == group_[order[i - 1]]) ++i;
      if (i < order.size()) cuts.push_back(i);
    }
    cuts.push_back(order.size());
    const auto runs = parallel::transform_with(
        sight_.context, {.name = "hidden lines: polygons", .n = cuts.size() - 1},
        [&] { return PolygonMaker(seen_, part_index_, sight_.picture); },
        [&](PolygonMaker& own, std::size_t r) {
          Polygons out;
          add(own, cuts[r], cuts[r + 1], out);
          return out;
        });
    if (!runs) return runs.error();
    return append(view_, *runs, sight_.context);
  }

  const Part& part_;
  std::uint32_t part_index_;
  std::uint32_t first_ = 0;
  const Sight& sight_;
  const Viewer& viewer_;
  std::span<const EdgeView> edges_;
  ShapeView& view_;
  PartSight seen_;
  std::vector<std::uint32_t> group_;
};

}  // namespace

Result<bool> add_polygons(const Part& part, std::uint32_t part_index, const Sight& sight,
                          std::span<const EdgeView> edges, ShapeView& view) {
  return PartMerger(part, part_index, sight, edges, view).run();
}

}  // namespace strake::hlr
