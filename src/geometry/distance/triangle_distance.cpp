// SPDX-License-Identifier: Apache-2.0
#include "geometry/distance/triangle_distance.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "geometry/distance/elementary_distance.hpp"
#include "geometry/numeric/triangle_math.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "geometry/predicates/feature_distance.hpp"
#include "strake/geometry/predicates.hpp"
#include "strake/geometry/triangle_contact.hpp"

namespace strake::geometry {
namespace {

double square(double x) { return x * x; }
double largest_magnitude(const Vec3d& v) {
  return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
}

Corners relative(const TriangleCorners& t, const Vec3l& base) {
  return {(t[0] - base).as<double>(), (t[1] - base).as<double>(), (t[2] - base).as<double>()};
}

/// Returns the squared distance across a slab of direction w and width `gap`, rounded down. The
/// products with corners no larger than `size` are each off by less than 2^-50·|w|·size.
double slab_distance(double gap, const Vec3d& w, double w_squared, double size) {
  const double sure = gap - 0x1p-47 * largest_magnitude(w) * size;
  return sure > 0 ? square(sure) / w_squared * (1 - 0x1p-48) : 0;
}

struct Extent {
  double low, high;
};

Extent extent(const Vec3d& w, const Corners& t) {
  const double x = dot(w, t[0]), y = dot(w, t[1]), z = dot(w, t[2]);
  return {std::min(std::min(x, y), z), std::max(std::max(x, y), z)};
}

double gap_between(const Extent& x, const Extent& y) {
  return std::max(x.low - y.high, y.low - x.high);
}

/// Returns a lower bound of the squared distance from the slab across direction w; any w is valid.
double slab(const Vec3d& w, const DoubleTriangle& a, const DoubleTriangle& b) {
  return slab_distance(gap_between(extent(w, a.corner), extent(w, b.corner)), w, squared_length(w),
                       std::max(a.size, b.size));
}

/// Returns the same bound across the first triangle's normal.
double normal_slab(const DoubleTriangle& a, const DoubleTriangle& b) {
  return slab_distance(gap_between({a.low, a.high}, extent(a.normal, b.corner)), a.normal,
                       a.normal_squared, std::max(a.size, b.size));
}

/// Returns the greatest bound by slabs perpendicular to the first triangle's edges, in its plane;
/// that of two coplanar triangles is among these. Stops at the first above `cutoff`.
double side_slabs(const DoubleTriangle& a, const DoubleTriangle& b, double cutoff) {
  double widest = 0;
  for (std::size_t i = 0; i < 3 && widest <= cutoff; ++i)
    widest = std::max(widest, slab(cross(a.normal, a.corner[next_corner(i)] - a.corner[i]), a, b));
  return widest;
}

/// The best pair of points so far.
struct Near {
  double squared = std::numeric_limits<double>::infinity();
  Vec3d on_a, on_b;

  void offer(const Vec3d& p, const Vec3d& q) {
    const double s = squared_length(q - p);
    if (s < squared) *this = {s, p, q};
  }
};

void offer_segments(const Vec3d& p, const Vec3d& d, const Vec3d& q, const Vec3d& e, Near& near) {
  const auto [s, t] = closest_on_segments(p, d, q, e);
  near.offer(p + d * s, q + e * t);
}

/// Offers the foot of a vertex on a triangle, where it falls inside: a convex combination of the
/// corners, so that it lies in the triangle even where a sliver's normal is mostly rounding.
template <class Offer>
void offer_foot(const Vec3d& corner, const Corners& t, const Vec3d& n, const Offer& offer) {
  const double w2 = dot(cross(t[1] - t[0], corner - t[0]), n);
  const double w0 = dot(cross(t[2] - t[1], corner - t[1]), n);
  const double w1 = dot(cross(t[0] - t[2], corner - t[2]), n);
  const double sum = w0 + w1 + w2;
  if (!(w0 >= 0 && w1 >= 0 && w2 >= 0 && sum > 0)) return;
  offer(t[0] * (w0 / sum) + t[1] * (w1 / sum) + t[2] * (w2 / sum));
}

/// Offers the points where edges of the first triangle cross the second's plane: triangles that
/// cross have no nearest features, but an edge of one of them meets the other.
template <class Offer>
void offer_crossings(const DoubleTriangle& a, const DoubleTriangle& b, const Offer& offer) {
  const Vec3d& on_b = b.corner[0];
  std::array<double, 3> height;
  for (std::size_t i = 0; i < 3; ++i) height[i] = dot(b.normal, a.corner[i] - on_b);
  for (std::size_t i = 0; i < 3; ++i) {
    const double from = height[i], to = height[next_corner(i)];
    if (!(from * to < 0)) continue;
    const Vec3d p = a.corner[i] + (a.corner[next_corner(i)] - a.corner[i]) * (from / (from - to));
    offer_foot(p, b.corner, b.normal, [&](const Vec3d& foot) { offer(p, foot); });
  }
}

/// Returns the exact width between the triangles across a direction (times its length).
Int128 width_across(const Vec3<Int128>& direction, const TriangleCorners& a,
                    const TriangleCorners& b) {
  const auto reach = [&](const TriangleCorners& t) {
    std::array<Int128, 3> r;
    for (std::size_t i = 0; i < 3; ++i) r[i] = dot(direction, (t[i] - a[0]).as<Int128>());
    return std::minmax({r[0], r[1], r[2]});
  };
  const auto [low_a, high_a] = reach(a);
  const auto [low_b, high_b] = reach(b);
  return std::max(low_b - high_a, low_a - high_b);
}

/// Finds the least exact distance over the pairs of features whose value in doubles may be as small
/// as the upper bound.
class ExactSearch {
 public:
  ExactSearch(const TriangleCorners& a, const TriangleCorners& b, double upper)
      : a_(a),
        b_(b),
        near_a_(relative(a, a[0])),
        near_b_(relative(b, a[0])),
        reach_(std::sqrt(upper) * (1 + 0x1p-40)) {}

  NearestTrianglePoints run();

 private:
  void corners();
  void corners_edges();
  void corners_faces();
  void edges();
  void find_direction();
  void offer(const FeatureDistance& value, const Vec3d& p, const Vec3d& q);

  /// Whether |height|/|n| <= reach cannot be excluded, for n = u x v and height = n·d in doubles,
  /// each component of n off by 2^-51·|u||v| at most.
  [[nodiscard]] bool within_reach(const Vec3d& u, const Vec3d& v, const Vec3d& n,
                                  const Vec3d& d) const {
    const double error = 0x1p-46 * largest_magnitude(u) * largest_magnitude(v);
    const double height = std::fabs(dot(n, d)) - error * largest_magnitude(d);
    return height <= reach_ * (std::sqrt(squared_length(n)) * (1 + 0x1p-40) + error);
  }

  [[nodiscard]] Vec3d absolute(const Vec3d& p) const { return p + a_[0].as<double>(); }

  const TriangleCorners& a_;
  const TriangleCorners& b_;
  Corners near_a_, near_b_;  ///< in doubles, relative to the first corner of a: exact
  double reach_;
  bool any_ = false;
  NearestTrianglePoints best_;
};

void ExactSearch::offer(const FeatureDistance& value, const Vec3d& p, const Vec3d& q) {
  if (any_ && value.squared >= best_.squared) return;
  any_ = true;
  best_ = {value.squared, absolute(p), absolute(q), value.direction, value.width};
}

void ExactSearch::corners() {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const Vec3d &p = near_a_[i], &q = near_b_[j];
      if (std::sqrt(squared_length(q - p)) * (1 - 0x1p-40) > reach_) continue;
      offer(feature::vertex_vertex(a_[i], b_[j]), p, q);
    }
}

/// Returns the foot of a point on the line of an edge.
Vec3d foot_on_edge(const Vec3d& p, const Vec3d& from, const Vec3d& to) {
  const Vec3d e = to - from;
  return from + e * (dot(e, p - from) / dot(e, e));
}

void ExactSearch::corners_edges() {
  FeatureDistance s;
  const auto near = [this](const Vec3d& p, const Vec3d& from, const Vec3d& to) {
    // |d x e| / |e|, off by less than 2^-48 of |d|.
    const Vec3d e = to - from, d = p - from;
    const double length = std::sqrt(squared_length(e));
    return std::sqrt(squared_length(cross(d, e))) <=
           length * (reach_ + 0x1p-46 * largest_magnitude(d));
  };
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const Vec3d &p = near_a_[i], &q = near_b_[j], &r = near_b_[next_corner(j)];
      if (near(p, q, r) && feature::vertex_edge(a_[i], b_[j], b_[next_corner(j)], s))
        offer(s, p, foot_on_edge(p, q, r));
    }
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const Vec3d &p = near_a_[i], &q = near_a_[next_corner(i)], &r = near_b_[j];
      if (near(r, p, q) && feature::vertex_edge(b_[j], a_[i], a_[next_corner(i)], s))
        offer(s, foot_on_edge(r, p, q), r);
    }
}

void ExactSearch::corners_faces() {
  FeatureDistance s;
  const auto foot = [](const Vec3d& p, const Corners& t) {
    const Vec3d n = normal_of(t);
    return p - n * (dot(n, p - t[0]) / squared_length(n));
  };
  const auto near = [this](const Vec3d& p, const Corners& t) {
    const Vec3d u = t[1] - t[0], v = t[2] - t[0];
    return within_reach(u, v, cross(u, v), p - t[0]);
  };
  for (std::size_t i = 0; i < 3; ++i)
    if (near(near_a_[i], near_b_) && feature::vertex_face(a_[i], b_, s))
      offer(s, near_a_[i], foot(near_a_[i], near_b_));
  for (std::size_t j = 0; j < 3; ++j)
    if (near(near_b_[j], near_a_) && feature::vertex_face(b_[j], a_, s))
      offer(s, foot(near_b_[j], near_a_), near_b_[j]);
}

void ExactSearch::edges() {
  FeatureDistance s;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const Vec3d &p = near_a_[i], &q = near_b_[j];
      const Vec3d e = near_a_[next_corner(i)] - p, f = near_b_[next_corner(j)] - q;
      if (!within_reach(e, f, cross(e, f), q - p)) continue;
      if (!feature::edge_edge(a_[i], a_[next_corner(i)], b_[j], b_[next_corner(j)], s)) continue;
      Near near;
      offer_segments(p, e, q, f, near);
      offer(s, near.on_a, near.on_b);
    }
}

/// Between parallel faces a vertex may project onto an edge: a normal serves as well.
void ExactSearch::find_direction() {
  for (const TriangleCorners* t : {&a_, &b_}) {
    const Vec3<Int128> n = cross_exact((*t)[1] - (*t)[0], (*t)[2] - (*t)[0]);
    const Int128 width = width_across(n, a_, b_);
    if (width <= 0) continue;
    const SquaredDistance across{mul(width, width), narrow<3>(feature::norm(n))};
    if (across != best_.squared) continue;
    best_.direction = n;
    best_.width = width;
    return;
  }
}

NearestTrianglePoints ExactSearch::run() {
  const ExactTriangle a(a_), b(b_);
  const TriangleContact c = contact(a, b);
  if (c.touch != Touch::none) {
    const Vec3d p = common_point(a, b, c);
    return {{}, p, p, {}, 0};
  }
  corners();
  corners_edges();
  corners_faces();
  edges();
  assert(any_);
  if (best_.width == 0) find_direction();
  return best_;
}

}  // namespace

DoubleTriangle::DoubleTriangle(const TriangleCorners& t)
    : corner(as_doubles(t)),
      box{corner[0], corner[0]},
      normal(normal_of(corner)),
      normal_squared(squared_length(normal)) {
  box.include(corner[1]);
  box.include(corner[2]);
  size = std::max(largest_magnitude(box.lo), largest_magnitude(box.hi));
  const Extent own = extent(normal, corner);
  low = own.low;
  high = own.high;
}

DistanceBounds triangle_distance_bounds(const DoubleTriangle& a, const DoubleTriangle& b,
                                        double cutoff, double near_enough) {
  // The points are off the triangles by a few roundings of the coordinates.
  const auto rounded_up = [&](double squared) {
    return square(std::sqrt(squared) + 0x1p-46 * std::max(a.size, b.size));
  };
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  const Corners &p = a.corner, &q = b.corner;
  if (near_enough >= 0)  // most such pairs are near at their vertices
    for (const Vec3d& from : p)
      for (const Vec3d& to : q)
        if (const double squared = squared_length(to - from);
            squared <= near_enough && rounded_up(squared) <= near_enough)
          return {0, rounded_up(squared)};
  double lower = normal_slab(a, b);
  if (lower > cutoff) return {lower, kUnknown};
  lower = std::max(lower, normal_slab(b, a));
  if (lower > cutoff) return {lower, kUnknown};
  if (near_enough >= 0) {
    lower = std::max(lower, side_slabs(a, b, cutoff));
    if (lower > cutoff) return {lower, kUnknown};
    lower = std::max(lower, side_slabs(b, a, cutoff));
    if (lower > cutoff) return {lower, kUnknown};
  }
  Near near;
  for (std::size_t i = 0; i < 3; ++i) {
    near.offer(p[i], q[i]);
    offer_foot(q[i], p, a.normal, [&](const Vec3d& foot) { near.offer(foot, q[i]); });
    offer_foot(p[i], q, b.normal, [&](const Vec3d& foot) { near.offer(p[i], foot); });
  }
  lower = std::max(lower, slab(near.on_b - near.on_a, a, b));
  if (lower > cutoff) return {lower, kUnknown};
  offer_crossings(a, b, [&](const Vec3d& of_a, const Vec3d& of_b) { near.offer(of_a, of_b); });
  offer_crossings(b, a, [&](const Vec3d& of_b, const Vec3d& of_a) { near.offer(of_a, of_b); });
  const auto settled = [&] { return rounded_up(near.squared) <= near_enough; };
  if (settled()) return {lower, rounded_up(near.squared)};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      offer_segments(p[i], p[next_corner(i)] - p[i], q[j], q[next_corner(j)] - q[j], near);
      if (settled()) return {lower, rounded_up(near.squared)};
    }
  lower = std::max(lower, slab(near.on_b - near.on_a, a, b));
  return {lower, rounded_up(near.squared)};
}

bool not_nearer(const TriangleCorners& a, const TriangleCorners& b,
                const NearestTrianglePoints& than) {
  return than.width > 0 && width_across(than.direction, a, b) >= than.width;
}

NearestTrianglePoints exact_triangle_distance(const TriangleCorners& a, const TriangleCorners& b,
                                              double upper) {
  return ExactSearch(a, b, upper).run();
}

}  // namespace strake::geometry
