// SPDX-License-Identifier: Apache-2.0
// Merges exactly coplanar triangles into convex polygons.
#include <algorithm>
#include <cstdlib>

#include "hlr/convexity.hpp"
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
  PartMerger(const Part& part, std::uint32_t part_index, const Frame& frame, ShapeView& view)
      : part_(part), part_index_(part_index), frame_(frame), view_(view) {}

  bool run() {
    first_ = static_cast<std::uint32_t>(view_.polygons.size());
    project();
    if (!narrow()) {
      for (std::uint32_t t = 0; t < part_.triangles.size(); ++t) add_wide(t);
      if (PartView part = finished(kTreeFrom); part.first < part.last)
        view_.parts.push_back(std::move(part));
      return false;
    }
    find_planes();
    const bool convex = walk_edges() && bounds_convex_body(part_, planes_);
    add_groups();
    PartView part = finished(convex ? kTreeFromIfConvex : kTreeFrom);
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

  void project() {
    points_.reserve(part_.vertices.size());
    for (const Vec3i& v : part_.vertices) points_.push_back(frame_(v.as<std::int64_t>()));
  }

  void find_planes() {
    const Vec3l& d = frame_.direction();
    planes_.resize(part_.triangles.size());
    for (std::size_t t = 0; t < planes_.size(); ++t) {
      const Triangle& i = part_.triangles[t];
      const Vec3l p = part_.vertices[i[0]].as<std::int64_t>();
      const Vec3l n = cross(part_.vertices[i[1]].as<std::int64_t>() - p,
                            part_.vertices[i[2]].as<std::int64_t>() - p);
      planes_[t].n = {n.x, n.y, n.z};
      planes_[t].facing = static_cast<Int128>(n.x) * d.x + static_cast<Int128>(n.y) * d.y +
                          static_cast<Int128>(n.z) * d.z;
    }
  }

  [[nodiscard]] bool runs(std::uint32_t t, const geometry::PartEdge& e) const {
    return runs_along(part_.triangles[t], e.v0, e.v1);
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
      if (runs(s, e) == runs(t, e)) {
        convex = false;
        continue;
      }
      const Int128 bend = height(planes_[s].n, part_.vertices[corner_off(part_.triangles[t], e)],
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
    const auto &m = planes_[s].n, &n = planes_[t].n;
    for (std::size_t k = 0; k < 3; ++k)
      if (m[k] != 0) return (m[k] > 0) != (n[k] > 0);
    return true;
  }

  void add_wide(std::uint32_t t) {
    NormalVector n = triangle_normal(part_, t);
    const Int128 facing = along(n, frame_.direction());
    if (facing == 0) return;
    Triangle i = part_.triangles[t];
    if (facing < 0) {
      for (Int128& x : n) x = -x;
      std::swap(i[1], i[2]);
    }
    Polygon& p = start(i[0]);
    p.wide = static_cast<std::int32_t>(view_.wide_normals.size());
    view_.wide_normals.push_back(n);
    for (const std::uint32_t v : i) add_corner(p, v);
  }

  Polygon& start(std::uint32_t vertex) {
    Polygon& p = view_.polygons.emplace_back();
    p.at = part_.vertices[vertex];
    p.part = part_index_;
    p.first_corner = static_cast<std::uint32_t>(view_.corners.size());
    return p;
  }

  void add_corner(Polygon& p, std::uint32_t vertex) {
    const ViewPoint& q = points_[vertex];
    p.box.include(q);
    ++p.corners;
    view_.corners.push_back({q.u, q.v});
  }

  // The edges between faces towards the viewer and the others, as one loop (certified convex
  // parts: every edge has two triangles).
  bool contour() {
    next_.assign(part_.vertices.size(), geometry::kNoFace);
    std::size_t count = 0;
    std::uint32_t from = geometry::kNoFace;
    for (std::size_t k = 0; k + 1 < part_.edges.size(); ++k) {
      const geometry::PartEdge& e = part_.edges[k];
      std::uint32_t s = part_.edge_triangles[e.first_triangle];
      const std::uint32_t t = part_.edge_triangles[e.first_triangle + 1];
      if ((planes_[s].facing > 0) == (planes_[t].facing > 0)) continue;
      if (planes_[t].facing > 0) s = t;
      const bool along_edge = runs(s, e);
      from = along_edge ? e.v0 : e.v1;
      if (next_[from] != geometry::kNoFace) return false;
      next_[from] = along_edge ? e.v1 : e.v0;
      ++count;
    }
    loop_.clear();
    for (std::uint32_t v = from; v != geometry::kNoFace && loop_.size() < count; v = next_[v])
      loop_.push_back(v);
    return count >= 3 && loop_.size() == count && next_[loop_.back()] == from;
  }

  // The outline of a certified convex part, as one polygon.
  void add_outline(PartView& view) {
    if (!contour() || !is_convex_loop()) return;
    view.outline.part = part_index_;
    view.outline.first_corner = static_cast<std::uint32_t>(view_.corners.size());
    for (const std::uint32_t v : loop_) add_corner(view.outline, v);
    view.outline.box = view.box;
    const auto d = frame_.direction().as<double>();
    double steepest = 0;
    for (std::uint32_t i = view.first; i < view.last; ++i) {
      const Polygon& p = view_.polygons[i];
      const geometry::Vec3d n = geometry::Vec3l{p.normal[0], p.normal[1], p.normal[2]}.as<double>();
      const auto facing = static_cast<double>(along(view_.normal(p), frame_.direction()));
      steepest = std::max(steepest, (std::abs(n.x) + std::abs(n.y) + std::abs(n.z)) / facing);
    }
    // Rounding of the few operations above is far below the share added.
    view.deep_per_contact = steepest * dot(d, d) * (1 + 1e-9);
    view.has_outline = true;
  }

  void add_polygon(std::uint32_t t, const std::vector<std::uint32_t>& loop) {
    Polygon& p = start(loop[0]);
    p.normal = planes_[t].n;
    if (planes_[t].facing < 0)
      for (std::int64_t& x : p.normal) x = -x;
    for (const std::uint32_t v : loop) add_corner(p, v);
  }

  void add_groups() {
    std::vector<std::uint32_t> order;
    order.reserve(planes_.size());
    for (std::uint32_t t = 0; t < planes_.size(); ++t)
      if (planes_[t].facing != 0) order.push_back(t);
    const auto by_group = [&](std::uint32_t s, std::uint32_t t) {
      return group_[s] < group_[t] || (group_[s] == group_[t] && s < t);
    };
    if (!std::is_sorted(order.begin(), order.end(), by_group))
      std::sort(order.begin(), order.end(), by_group);
    next_.assign(part_.vertices.size(), geometry::kNoFace);
    for (std::size_t i = 0, end = 0; i < order.size(); i = end) {
      while (end < order.size() && group_[order[end]] == group_[order[i]]) ++end;
      add_group(std::span(order).subspan(i, end - i));
    }
  }

  void add_group(std::span<const std::uint32_t> triangles) {
    const bool found = triangles.size() == 2 ? outline_of_pair(triangles[0], triangles[1])
                                             : triangles.size() > 2 && outline(triangles);
    if (found && is_convex_loop()) {
      add_polygon(triangles[0], loop_);
      return;
    }
    for (const std::uint32_t t : triangles) {
      const Triangle& i = part_.triangles[t];
      loop_.assign(i.begin(), i.end());
      if (planes_[t].facing < 0) std::swap(loop_[1], loop_[2]);
      add_polygon(t, loop_);
    }
  }

  // The same for two triangles that share an edge, without sorting.
  bool outline_of_pair(std::uint32_t s, std::uint32_t t) {
    const Triangle &i = part_.triangles[s], &j = part_.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = i[k], b = i[(k + 1) % 3], c = i[(k + 2) % 3];
      for (std::size_t m = 0; m < 3; ++m) {
        if (j[m] != b || j[(m + 1) % 3] != a) continue;
        loop_ = {a, j[(m + 2) % 3], b, c};
        if (planes_[s].facing < 0) std::reverse(loop_.begin(), loop_.end());
        return loop_[0] != loop_[2] && loop_[1] != loop_[3];
      }
    }
    return false;
  }

  // The single closed outline of a group, counter-clockwise to the viewer; false if there are
  // more loops or one that touches itself.
  bool outline(std::span<const std::uint32_t> triangles) {
    directed_.clear();
    const bool front = planes_[triangles[0]].facing > 0;
    for (const std::uint32_t t : triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = part_.triangles[t][k], b = part_.triangles[t][(k + 1) % 3];
        directed_.push_back(front ? std::array{a, b} : std::array{b, a});
      }
    std::sort(directed_.begin(), directed_.end());
    std::size_t kept = 0;
    std::uint32_t from = geometry::kNoFace;
    bool simple = true;
    touched_.clear();
    for (const auto& e : directed_) {
      if (std::binary_search(directed_.begin(), directed_.end(), std::array{e[1], e[0]})) continue;
      simple = simple && next_[e[0]] == geometry::kNoFace;
      next_[e[0]] = e[1];
      touched_.push_back(e[0]);
      from = e[0];
      ++kept;
    }
    loop_.clear();
    if (simple && kept >= 3)
      for (std::uint32_t v = from; loop_.size() < kept && v != geometry::kNoFace;) {
        loop_.push_back(v);
        v = next_[v];
        if (v == from) break;
      }
    for (const std::uint32_t v : touched_) next_[v] = geometry::kNoFace;
    return simple && kept >= 3 && loop_.size() == kept;
  }

  // Drops corners on straight runs; true when the rest turns left everywhere, and once round.
  bool is_convex_loop() {
    corners_.clear();
    const std::size_t n = loop_.size();
    for (std::size_t i = 0; i < n; ++i) {
      const ViewPoint &p = points_[loop_[(i + n - 1) % n]], &q = points_[loop_[i]],
                      &r = points_[loop_[(i + 1) % n]];
      const Int128 turn = static_cast<Int128>(q.u - p.u) * (r.v - q.v) -
                          static_cast<Int128>(q.v - p.v) * (r.u - q.u);
      if (turn < 0) return false;
      if (turn > 0) corners_.push_back(loop_[i]);
    }
    if (corners_.size() < 3) return false;
    const std::size_t m = corners_.size();
    std::size_t ascents = 0;
    bool rising = is_rising(corners_[m - 1], corners_[0]);
    for (std::size_t i = 0; i < m; ++i) {
      const bool now = is_rising(corners_[i], corners_[(i + 1) % m]);
      if (now && !rising) ++ascents;
      rising = now;
    }
    loop_.swap(corners_);
    return ascents == 1;
  }
  [[nodiscard]] bool is_rising(std::uint32_t from, std::uint32_t to) const {
    const ViewPoint s = points_[to] - points_[from];
    return s.v > 0 || (s.v == 0 && s.u > 0);
  }

  const Part& part_;
  std::uint32_t part_index_;
  std::uint32_t first_ = 0;
  const Frame& frame_;
  ShapeView& view_;
  std::vector<ViewPoint> points_;
  std::vector<TrianglePlane> planes_;
  std::vector<std::uint32_t> group_, next_, loop_, corners_, touched_;
  std::vector<std::array<std::uint32_t, 2>> directed_;
};

}  // namespace

bool add_polygons(const Part& part, std::uint32_t part_index, const Frame& frame, ShapeView& view) {
  return PartMerger(part, part_index, frame, view).run();
}

}  // namespace strake::hlr
