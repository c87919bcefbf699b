// SPDX-License-Identifier: Apache-2.0
#include "geometry/intersect/radial_sort.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "geometry/numeric/triangle_math.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/predicates.hpp"

namespace strake::geometry {
namespace {

/// Whether two points of one plane through the axis lie on the same side of the axis.
bool same_side(const Vec3l& from, const Vec3l& to, const Vec3l& p, const Vec3l& q) {
  for (int axis = 0; axis < 3; ++axis) {
    const int turn = orient2d(from, to, p, axis);
    if (turn != 0) return turn == orient2d(from, to, q, axis);
  }
  return false;
}

}  // namespace

void RadialSort::sort() {
  sorted_.clear();
  const Vec3l& first = half_planes_.front().point;
  for (const HalfPlane& ray : half_planes_) {
    const int turn = orient3d(from_, to_, first, ray.point);
    const int half = turn > 0 ? 1 : turn < 0 ? 3 : same_side(from_, to_, first, ray.point) ? 0 : 2;
    sorted_.push_back({ray, half, false});
  }
  const auto turn = [this](const Sorted& x, const Sorted& y) {
    return orient3d(from_, to_, x.ray.point, y.ray.point);
  };
  // Insertion sort: there are nearly always four half-planes.
  for (std::size_t i = 1; i < sorted_.size(); ++i)
    for (std::size_t j = i; j > 0; --j) {
      const Sorted &x = sorted_[j - 1], &y = sorted_[j];
      const bool in_order =
          x.half != y.half ? x.half < y.half : (x.half % 2 == 0 || turn(x, y) >= 0);
      if (in_order) break;
      std::swap(sorted_[j - 1], sorted_[j]);
    }
  for (std::size_t i = 0; i < sorted_.size(); ++i)
    sorted_[i].opens = i == 0 || sorted_[i].half != sorted_[i - 1].half ||
                       (sorted_[i].half % 2 == 1 && turn(sorted_[i - 1], sorted_[i]) != 0);
}

void RadialSort::gather() {
  directions_.clear();
  int a = 0, b = 0;
  for (std::size_t i = 0; i < sorted_.size(); ++i) {
    const Sorted& s = sorted_[i];
    if (s.opens) directions_.push_back({.first = i});
    Direction& d = directions_.back();
    d.end = i + 1;
    (s.ray.of_b ? d.has_b : d.has_a) = true;
    (s.ray.of_b ? b : a) += s.ray.step;
    d.after_a = a;
    d.after_b = b;
  }
  // Only differences are known here; some angle round an edge of the boundary is outside.
  int lowest_a = directions_.front().after_a, lowest_b = directions_.front().after_b;
  for (const Direction& d : directions_) {
    lowest_a = std::min(lowest_a, d.after_a);
    lowest_b = std::min(lowest_b, d.after_b);
  }
  for (Direction& d : directions_) {
    d.after_a -= lowest_a;
    d.after_b -= lowest_b;
  }
}

void RadialSort::classify_sheets(Overlap& overlap) const {
  // If the pure directions alternate a, b, a, b, each passes through the other.
  int changes = 0;
  const Direction* previous = nullptr;
  const Direction* first = nullptr;
  for (const Direction& d : directions_) {
    if (d.has_a && !d.has_b) overlap.a_leaves_b = true;
    if (d.has_b && !d.has_a) overlap.b_leaves_a = true;
    if (d.has_a == d.has_b) continue;
    if (previous != nullptr && previous->has_a != d.has_a) ++changes;
    if (first == nullptr) first = &d;
    previous = &d;
  }
  if (previous != nullptr && previous->has_a != first->has_a) ++changes;
  if (changes >= 4) overlap.interiors = true;
}

/// Returns whether one sheet has a half-plane of its own between direction `from` and the next of
/// the other, stepping by `step`; -1 where the other has no next one: there it ends.
int RadialSort::other_leaves(std::size_t from, std::size_t step, bool b_leaves) const {
  const std::size_t count = directions_.size();
  bool leaves = false;
  for (std::size_t i = (from + step) % count; i != from; i = (i + step) % count) {
    const Direction& d = directions_[i];
    if (b_leaves ? d.has_a : d.has_b) return leaves ? 1 : 0;
    leaves = true;
  }
  return -1;
}

int RadialSort::find_coincident(std::vector<CoincidentTriangles>& flush) const {
  flush.clear();
  int count = 0;
  for (std::size_t i = 0; i < directions_.size(); ++i) {
    const Direction& d = directions_[i];
    if (!d.has_a || !d.has_b) continue;
    // Where b goes on clockwise of a, a is counter-clockwise of b.
    const std::size_t back = directions_.size() - 1;
    const bool after = other_leaves(i, 1, false) == 1 || other_leaves(i, back, true) == 1;
    const bool before = other_leaves(i, back, false) == 1 || other_leaves(i, 1, true) == 1;
    for (std::size_t j = d.first; j < d.end; ++j)
      for (std::size_t k = d.first; k < d.end; ++k) {
        const HalfPlane &a = sorted_[j].ray, &b = sorted_[k].ray;
        if (a.of_b || !b.of_b) continue;
        flush.push_back({a.triangle, b.triangle, count, b.step, b.step < 0 ? after : before,
                         b.step < 0 ? before : after});
      }
    ++count;
  }
  return count;
}

void RadialSort::classify(bool a_solid, bool b_solid, Overlap& overlap) {
  if (half_planes_.empty()) return;
  sort();
  gather();
  if (!a_solid && !b_solid) {
    classify_sheets(overlap);
    return;
  }
  for (std::size_t i = 0; i < directions_.size(); ++i) {
    const Direction& d = directions_[i];
    const Direction& before = directions_[i == 0 ? directions_.size() - 1 : i - 1];
    const bool in_a = d.after_a > 0, in_b = d.after_b > 0;
    if (a_solid && b_solid) {
      overlap.interiors |= in_a && in_b;
      overlap.a_leaves_b |= in_a && !in_b;
      overlap.b_leaves_a |= in_b && !in_a;
    } else if (b_solid) {
      overlap.b_leaves_a |= in_b;
      overlap.interiors |= d.has_a && in_b && before.after_b > 0;
      overlap.a_leaves_b |= d.has_a && !d.has_b && !in_b;
    } else {
      overlap.a_leaves_b |= in_a;
      overlap.interiors |= d.has_b && in_a && before.after_a > 0;
      overlap.b_leaves_a |= d.has_b && !d.has_a && !in_a;
    }
  }
}

namespace {

std::span<const std::uint32_t> star_between(const Part& part, std::uint32_t u, std::uint32_t v) {
  const std::uint32_t edge = edge_between(part, u, v);
  return edge == kNoIndex ? std::span<const std::uint32_t>{} : incident_triangles(part, edge);
}

/// Whether two parallel directions point the same way.
bool same_way(const Vec3l& d, const Vec3l& e) {
  for (int k = 0; k < 3; ++k)
    if (d[k] != 0) return (d[k] > 0) == (e[k] > 0);
  return true;
}

}  // namespace

std::span<const std::uint32_t> edge_star(const Part& part, std::uint32_t triangle, int edge) {
  const Triangle& t = part.triangles[triangle];
  return star_between(part, t[at(edge)], t[at(next_corner(edge))]);
}

void set_axis(RadialSort& sectors, const PairLocalPart& view, std::uint32_t triangle, int edge) {
  const Triangle& t = view.part().triangles[triangle];
  sectors.start(view.vertex(t[at(edge)]), view.vertex(t[at(next_corner(edge))]));
}

void add_edge_star(RadialSort& sectors, const PairLocalPart& view, std::uint32_t triangle, int edge,
                   bool of_b) {
  const Part& part = view.part();
  const Triangle& t = part.triangles[triangle];
  std::uint32_t u = t[at(edge)], v = t[at(next_corner(edge))];
  if (!same_way(sectors.to() - sectors.from(), view.vertex(v) - view.vertex(u))) std::swap(u, v);
  for (const std::uint32_t other : star_between(part, u, v)) {
    const Triangle& o = part.triangles[other];
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t p = o[at(i)], q = o[at(next_corner(i))];
      if (!((p == u && q == v) || (p == v && q == u))) continue;
      // A triangle that runs along the axis has its outside counter-clockwise of it.
      sectors.add({view.vertex(o[at(next_corner(next_corner(i)))]), p == u ? -1 : 1, of_b, other});
    }
  }
}

void add_coordinate_face(RadialSort& sectors, const PairLocalPart& view, std::uint32_t triangle,
                         bool of_b) {
  const std::array<Vec3l, 3> t = view.corners(triangle);
  int axis = 0;
  while (t[0][axis] != t[1][axis] || t[0][axis] != t[2][axis]) ++axis;
  const int facing = orient2d(t[0], t[1], t[2], axis);
  const int x = (axis + 1) % 3, y = (axis + 2) % 3;
  Vec3l step;
  step[sectors.from()[y] != sectors.to()[y] ? x : y] = 1;
  for (const Vec3l& beside : {sectors.from() + step, sectors.from() - step}) {
    const int turn = orient2d(sectors.from(), sectors.to(), beside, axis);
    sectors.add({beside, turn == facing ? -1 : 1, of_b, triangle});
  }
}

void add_face(RadialSort& sectors, const PairLocalPart& view, std::uint32_t triangle, bool of_b) {
  const std::array<Vec3l, 3> t = view.corners(triangle);
  for (int axis = 0; axis < 3; ++axis) {
    const int facing = orient2d(t[0], t[1], t[2], axis);
    if (facing == 0) continue;
    bool left = false, right = false;
    for (const Vec3l& corner : t) {
      const int turn = orient2d(sectors.from(), sectors.to(), corner, axis);
      bool& done = turn > 0 ? left : right;
      if (turn == 0 || done) continue;
      done = true;
      sectors.add({corner, turn == facing ? -1 : 1, of_b, triangle});
    }
    return;
  }
}

}  // namespace strake::geometry
