// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/separating_axis.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>
#include <vector>

#include "geometry/predicates/feature_distance.hpp"
#include "geometry/predicates/line_clip.hpp"
#include "strake/geometry/predicates.hpp"

namespace strake::geometry {
namespace {

using Axis = Vec3<Int128>;

/// The features of a convex shape that define candidate axes.
struct Hull {
  std::vector<Vec3l> points;
  std::vector<Axis> normals;
  std::vector<Vec3l> edges;  ///< directions, none zero
};

bool zero(const Axis& v) { return v == Axis{}; }

bool parallel(const Axis& u, const Axis& v) {
  return mul(u.x, v.y) == mul(u.y, v.x) && mul(u.y, v.z) == mul(u.z, v.y) &&
         mul(u.z, v.x) == mul(u.x, v.z);
}

Int128 common_divisor(Int128 x, Int128 y) {
  x = feature::magnitude(x);
  y = feature::magnitude(y);
  while (y != 0) x = std::exchange(y, x % y);
  return x;
}

/// In lowest terms.
Axis reduced(const Axis& v) {
  const Int128 g = common_divisor(common_divisor(v.x, v.y), v.z);
  return {v.x / g, v.y / g, v.z / g};
}

/// In lowest terms, and of the two ways the lexicographically positive.
Axis canonical(const Axis& v) { return reduced(v < Axis{} ? -v : v); }

void add_edge(const Vec3l& e, Hull& hull) {
  if (e != Vec3l{}) hull.edges.push_back(canonical(e.as<Int128>()).as<std::int64_t>());
}

void add_normal(const Vec3l& u, const Vec3l& v, Hull& hull) {
  const Axis n = cross_exact(u, v);
  if (!zero(n)) hull.normals.push_back(n);
}

template <class T>
void keep_distinct(std::vector<T>& all) {
  std::ranges::sort(all);
  const auto rest = std::ranges::unique(all);
  all.erase(rest.begin(), rest.end());
}

Hull hull_of(const TriangleCorners& t) {
  Hull hull{{t.begin(), t.end()}, {}, {}};
  add_normal(t[1] - t[0], t[2] - t[0], hull);
  for (std::size_t i = 0; i < 3; ++i) add_edge(t[(i + 1) % 3] - t[i], hull);
  return hull;
}

Hull hull_of(const GridBox& box) {
  Hull hull;
  for (unsigned i = 0; i < 8; ++i) {
    Vec3l p = box.corner;
    for (unsigned k = 0; k < 3; ++k)
      if ((i >> k & 1U) != 0) p = p + box.edge[k];
    hull.points.push_back(p);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    add_edge(box.edge[k], hull);
    add_normal(box.edge[k], box.edge[(k + 1) % 3], hull);
  }
  return hull;
}

Hull hull_of(const ConvexSurface& body) {
  assert(!body.points.empty());
  Hull hull;
  hull.points.assign(body.points.begin(), body.points.end());
  if (body.triangles.empty()) {
    hull.points.resize(std::min<std::size_t>(hull.points.size(), 2));
    add_edge(hull.points.back() - hull.points.front(), hull);
    return hull;
  }
  for (const Triangle& t : body.triangles) {
    const Vec3l &p = body.points[t[0]], &q = body.points[t[1]], &r = body.points[t[2]];
    add_normal(q - p, r - p, hull);
    add_edge(q - p, hull);
    add_edge(r - q, hull);
    add_edge(p - r, hull);
  }
  for (Axis& n : hull.normals) n = canonical(n);
  keep_distinct(hull.normals);
  keep_distinct(hull.edges);
  return hull;
}

class AxisSearch {
 public:
  AxisSearch(const Hull& a, const Hull& b) : a_(a), b_(b) {}
  SeparatingAxis run();

 private:
  void offer(const Axis& axis);
  void offer_flat();
  void offer_projected_edges(const Axis& normal);
  [[nodiscard]] bool better(const Axis& axis, Int128 gap) const;

  const Hull &a_, &b_;
  bool any_ = false;
  bool spread_ = false;  ///< candidates point more than one way
  SeparatingAxis best_;
};

/// Signed squares over squared lengths decide; of equals the canonical axis.
bool AxisSearch::better(const Axis& axis, Int128 gap) const {
  if (!any_) return true;
  if ((gap > 0) != (best_.gap > 0) || (gap < 0) != (best_.gap < 0)) return gap > best_.gap;
  const auto mine = mul(mul(gap, gap), feature::norm(best_.axis));
  const auto other = mul(mul(best_.gap, best_.gap), feature::norm(axis));
  if (mine != other) return gap > 0 ? mine > other : mine < other;
  return canonical(axis) > canonical(best_.axis);
}

void AxisSearch::offer(const Axis& axis) {
  if (zero(axis)) return;
  const auto reach = [&](const Hull& hull) {
    Int128 lo = 0, hi = 0;
    for (std::size_t i = 0; i < hull.points.size(); ++i) {
      const Int128 at = dot(axis, (hull.points[i] - a_.points[0]).as<Int128>());
      lo = i == 0 ? at : std::min(lo, at);
      hi = i == 0 ? at : std::max(hi, at);
    }
    return std::pair{lo, hi};
  };
  const auto [low_a, high_a] = reach(a_);
  const auto [low_b, high_b] = reach(b_);
  const Int128 up = low_b - high_a, down = low_a - high_b;
  const Int128 gap = std::max(up, down);
  spread_ = spread_ || (any_ && !parallel(axis, best_.axis));
  if (!better(axis, gap)) return;
  const bool upward = up != down ? up > down : axis > Axis{};
  best_.axis = upward ? axis : -axis;
  best_.gap = gap;
  any_ = true;
}

/// The normals of the edges in the plane that both shapes are parallel to.
void AxisSearch::offer_projected_edges(const Axis& normal) {
  const int drop = any_axis(normal);
  for (const Hull* hull : {&a_, &b_})
    for (const Vec3l& e : hull->edges) {
      Axis across;
      across[(drop + 1) % 3] = -Int128{e[(drop + 2) % 3]};
      across[(drop + 2) % 3] = e[(drop + 1) % 3];
      offer(across);
    }
}

/// Where the candidates leave a plane or a line to look along.
void AxisSearch::offer_flat() {
  if (any_) {
    offer_projected_edges(Axis(best_.axis));
    return;
  }
  const Vec3l between = b_.points[0] - a_.points[0];
  const Hull& longer = a_.edges.empty() ? b_ : a_;
  const Vec3l way = longer.edges.empty() ? between : longer.edges[0];
  const Axis normal = cross_exact(way, between);
  if (!zero(normal)) {
    offer_projected_edges(normal);
    return;
  }
  // All on one line: try the axis along it, and one perpendicular to it, where there is no gap.
  const int main = std::max(any_axis(way.as<Int128>()), 0);
  Axis unit, other;
  unit[main] = 1;
  other[(main + 1) % 3] = 1;
  offer(unit);
  offer(cross(way.as<Int128>(), other));
}

SeparatingAxis AxisSearch::run() {
  for (const Hull* hull : {&a_, &b_})
    for (const Axis& n : hull->normals) offer(n);
  for (const Vec3l& e : a_.edges)
    for (const Vec3l& f : b_.edges) offer(cross_exact(e, f));
  if (!spread_) offer_flat();
  best_.separation = best_.gap > 0    ? Separation::apart
                     : best_.gap == 0 ? Separation::touching
                                      : Separation::overlapping;
  const Axis axis = best_.axis;
  best_.axis = reduced(axis);
  for (int k = 0; k < 3; ++k)
    if (axis[k] != 0) {
      // The gap shrinks with its axis: it is a sum of products with it.
      best_.gap /= axis[k] / best_.axis[k];
      break;
    }
  return best_;
}

GridBox grid_box(const Box3l& box) {
  assert(!box.empty());
  const Vec3l size = box.hi - box.lo;
  return {box.lo, {Vec3l{size.x, 0, 0}, {0, size.y, 0}, {0, 0, size.z}}};
}

}  // namespace

double SeparatingAxis::width() const {
  const double size = sqrt_ratio_to_double(mul(gap, gap), narrow<3>(feature::norm(axis)));
  return gap < 0 ? -size : size;
}

SeparatingAxis separating_axis(const TriangleCorners& a, const TriangleCorners& b) {
  return AxisSearch(hull_of(a), hull_of(b)).run();
}
SeparatingAxis separating_axis(const GridBox& a, const GridBox& b) {
  return AxisSearch(hull_of(a), hull_of(b)).run();
}
SeparatingAxis separating_axis(const Box3l& a, const Box3l& b) {
  return separating_axis(grid_box(a), grid_box(b));
}
SeparatingAxis separating_axis(const ConvexSurface& a, const ConvexSurface& b) {
  return AxisSearch(hull_of(a), hull_of(b)).run();
}

}  // namespace strake::geometry
