// SPDX-License-Identifier: Apache-2.0
// Merges exactly coplanar triangles into convex polygons.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "hlr/convexity.hpp"
#include "hlr/loops.hpp"
#include "hlr/shape_view.hpp"
#include "strake/core/disjoint_sets.hpp"
#include "strake/geometry/part_edges.hpp"

namespace strake::hlr {
namespace {

using geometry::corner_off;
using geometry::Part;
using geometry::runs_along;
using geometry::Triangle;
using geometry::Vec3i;
using geometry::Vec3l;

// A tree pays from this many polygons on.
constexpr std::uint32_t kTreeFrom = 12;
// The faces of convex parts are seldom asked: their outline is.
constexpr std::uint32_t kTreeFromIfConvex = 64;
// Parts up to this size have normals of 62 bits.
constexpr std::int64_t kNarrow = std::int64_t{1} << 30;

// The sign and value of n · (p - q).
Int128 height(const std::array<std::int64_t, 3>& n, const Vec3i& p, const Vec3i& q) {
  return static_cast<Int128>(n[0]) * (std::int64_t{p.x} - q.x) +
         static_cast<Int128>(n[1]) * (std::int64_t{p.y} - q.y) +
         static_cast<Int128>(n[2]) * (std::int64_t{p.z} - q.z);
}

class PartMerger {
 public:
  PartMerger(const Part& part, std::uint32_t part_index, const Sight& sight, ShapeView& view)
      : part_(part),
        part_index_(part_index),
        sight_(sight),
        viewer_(sight.features.viewer),
        view_(view),
        seen_{.part = part, .viewer = sight.features.viewer},
        loops_(seen_) {}

  bool run() {
    first_ = static_cast<std::uint32_t>(view_.polygons.size());
    seen_.project(sight_.frame);
    if (!narrow()) {
      for (std::uint32_t t = 0; t < part_.triangles.size(); ++t) add_wide(t);
      if (PartView part = finished(kTreeFrom); part.first < part.last)
        view_.parts.push_back(std::move(part));
      return false;
    }
    seen_.find_planes();
    const bool convex = walk_edges() && bounds_convex_body(part_, seen_.planes);
    add_groups();
    PartView part = finished(convex ? kTreeFromIfConvex : kTreeFrom);
    part.farthest = seen_.farthest();
    if (convex) add_outline(part);
    if (part.first < part.last) view_.parts.push_back(std::move(part));
    return convex;
  }

 private:
  [[nodiscard]] PartView finished(std::uint32_t tree_from) const {
    PartView part;
    part.first = first_;
    part.last = static_cast<std::uint32_t>(view_.polygons.size());
    std::vector<ViewBox> boxes;
    for (const Polygon& p : std::span(view_.polygons).subspan(first_)) {
      part.box.include(p.box);
      if (part.last - part.first >= tree_from) boxes.push_back(p.box);
    }
    if (!boxes.empty()) part.tree = ViewTree(boxes);
    return part;
  }

  [[nodiscard]] bool narrow() const {
    const auto lo = part_.box.lo.as<std::int64_t>(), hi = part_.box.hi.as<std::int64_t>();
    return hi.x - lo.x <= kNarrow && hi.y - lo.y <= kNarrow && hi.z - lo.z <= kNarrow;
  }

  // Groups coplanar neighbours; true when every edge is manifold, consistent and not concave.
  bool walk_edges() {
    DisjointSets groups(part_.triangles.size());
    bool convex = part_.kind == geometry::PartKind::solid && part_.shell_count == 1;
    for (std::size_t k = 0; k + 1 < part_.edges.size(); ++k) {
      const geometry::PartEdge& e = part_.edges[k];
      if (part_.edges[k + 1].first_triangle - e.first_triangle != 2) {
        convex = false;
        continue;
      }
      const std::uint32_t s = part_.edge_triangles[e.first_triangle];
      const std::uint32_t t = part_.edge_triangles[e.first_triangle + 1];
      if (runs_along(part_.triangles[s], e.v0, e.v1) ==
          runs_along(part_.triangles[t], e.v0, e.v1)) {
        convex = false;
        continue;
      }
      const Int128 bend =
          height(seen_.planes[s].n, part_.vertices[corner_off(part_.triangles[t], e)],
                 part_.vertices[e.v0]);
      if (bend > 0) convex = false;
      if (bend != 0) continue;
      if (is_folded(s, t)) {
        convex = false;
      } else {
        groups.join(s, t);
      }
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

  void add_wide(std::uint32_t t) {
    NormalVector n = triangle_normal(part_, t);
    Triangle i = part_.triangles[t];
    const Int128 facing = viewer_.facing(n, part_.vertices[i[0]].as<std::int64_t>());
    if (facing == 0) return;
    if (facing < 0) {
      for (Int128& x : n) x = -x;
      std::swap(i[1], i[2]);
    }
    Polygon& p = start(i[0]);
    p.wide = static_cast<std::int32_t>(view_.wide_normals.size());
    view_.wide_normals.push_back(n);
    add_corners(p, i);
  }

  Polygon& start(std::uint32_t vertex) {
    Polygon& p = view_.polygons.emplace_back();
    p.at = part_.vertices[vertex];
    p.part = part_index_;
    return p;
  }

  void add_corners(Polygon& p, std::span<const std::uint32_t> vertices) {
    p.corners = static_cast<std::uint32_t>(vertices.size());
    if (viewer_.eye) {
      p.first_corner = static_cast<std::uint32_t>(view_.rays.size());
      for (const std::uint32_t v : vertices) view_.rays.push_back(seen_.rays[v]);
      p.box = sight_.picture->box_of(std::span(view_.rays).last(vertices.size()));
      return;
    }
    p.first_corner = static_cast<std::uint32_t>(view_.corners.size());
    for (const std::uint32_t v : vertices) {
      p.box.include(seen_.points[v]);
      view_.corners.push_back({seen_.points[v].u, seen_.points[v].v});
    }
  }

  // The outline of a certified convex part, as one polygon.
  void add_outline(PartView& view) {
    if (!loops_.find_contour()) return;
    view.outline.part = part_index_;
    add_corners(view.outline, loops_.found());
    view.outline.box = view.box;
    double steepest = 0;
    for (std::uint32_t i = view.first; i < view.last; ++i) {
      const Polygon& p = view_.polygons[i];
      const geometry::Vec3d n = geometry::Vec3l{p.normal[0], p.normal[1], p.normal[2]}.as<double>();
      const auto facing =
          static_cast<double>(viewer_.facing(view_.normal(p), p.at.as<std::int64_t>()));
      steepest = std::max(steepest, (std::abs(n.x) + std::abs(n.y) + std::abs(n.z)) / facing);
    }
    // Rounding of the few operations above is far below the share added.
    view.deep_per_contact = steepest * reach() * (1 + 1e-9);
    view.has_outline = true;
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

  void add_polygon(std::uint32_t t) {
    Polygon& p = start(loops_.found()[0]);
    p.normal = seen_.towards_viewer(t);
    add_corners(p, loops_.found());
  }

  void add_groups() {
    std::vector<std::uint32_t> order;
    order.reserve(seen_.planes.size());
    for (std::uint32_t t = 0; t < seen_.planes.size(); ++t)
      if (seen_.planes[t].facing != 0) order.push_back(t);
    const auto by_group = [&](std::uint32_t s, std::uint32_t t) {
      return group_[s] < group_[t] || (group_[s] == group_[t] && s < t);
    };
    if (!std::is_sorted(order.begin(), order.end(), by_group))
      std::sort(order.begin(), order.end(), by_group);
    for (std::size_t i = 0, end = 0; i < order.size(); i = end) {
      while (end < order.size() && group_[order[end]] == group_[order[i]]) ++end;
      add_group(std::span(order).subspan(i, end - i));
    }
  }

  void add_group(std::span<const std::uint32_t> triangles) {
    if (loops_.find_outline(triangles)) {
      add_polygon(triangles[0]);
      return;
    }
    for (const std::uint32_t t : triangles) {
      loops_.take_triangle(t);
      add_polygon(t);
    }
  }

  const Part& part_;
  std::uint32_t part_index_;
  std::uint32_t first_ = 0;
  const Sight& sight_;
  const Viewer& viewer_;
  ShapeView& view_;
  PartSight seen_;
  Loops loops_;
  std::vector<std::uint32_t> group_;
};

}  // namespace

bool add_polygons(const Part& part, std::uint32_t part_index, const Sight& sight, ShapeView& view) {
  return PartMerger(part, part_index, sight, view).run();
}

}  // namespace strake::hlr
