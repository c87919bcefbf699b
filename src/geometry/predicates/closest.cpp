// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/closest.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>

#include "geometry/predicates/feature_distance.hpp"

namespace strake::geometry {
namespace {

/// A point, segment or triangle by its corners.
using Simplex = std::span<const Vec3l>;

constexpr std::size_t edges_of(const Simplex& s) { return s.size() == 3 ? 3 : s.size() - 1; }

/// An edge of a simplex with its mask.
struct Edge {
  Vec3l from, to;
  FeatureMask place = 0;
};

Edge edge(const Simplex& s, std::size_t i) {
  const std::size_t j = i + 1 == s.size() ? 0 : i + 1;
  return {s[i], s[j], static_cast<FeatureMask>((1U << i) | (1U << j))};
}

FeatureMask corner(std::size_t i) { return static_cast<FeatureMask>(1U << i); }
constexpr FeatureMask kFace = 7;

TriangleCorners triangle(const Simplex& s) { return {s[0], s[1], s[2]}; }

RationalPoint along(const Edge& e, const Int256& at, const FeatureDistance& gap) {
  return point_along(e.from, (e.to - e.from).as<Int128>(), at, gap.squared.denominator);
}

/// The foot on a face of a point that is off by `at_b` along its normal.
RationalPoint foot(const Vec3l& p, const FeatureDistance& gap) {
  return point_along(p, gap.direction, -gap.at_b, gap.squared.denominator);
}

class FeatureSearch {
 public:
  FeatureSearch(const Simplex& a, const Simplex& b) : a_(a), b_(b) {}

  ClosestPoints run() {
    corners();
    corners_edges();
    corners_faces();
    edges();
    pierced();
    return best_;
  }

 private:
  [[nodiscard]] bool nearer(const FeatureDistance& gap) const {
    return !any_ || gap.squared < best_.squared;
  }
  void take(const ClosestPoints& points) {
    any_ = true;
    best_ = points;
  }

  void corners();
  void corners_edges();
  void corners_faces();
  void edges();
  void pierced();

  Simplex a_, b_;
  bool any_ = false;
  ClosestPoints best_;
};

void FeatureSearch::corners() {
  for (std::size_t i = 0; i < a_.size(); ++i)
    for (std::size_t j = 0; j < b_.size(); ++j) {
      const FeatureDistance gap = feature::vertex_vertex(a_[i], b_[j]);
      if (nearer(gap))
        take({gap.squared, RationalPoint(a_[i]), RationalPoint(b_[j]), corner(i), corner(j)});
    }
}

void FeatureSearch::corners_edges() {
  FeatureDistance gap;
  for (std::size_t i = 0; i < a_.size(); ++i)
    for (std::size_t j = 0; j < edges_of(b_); ++j) {
      const Edge e = edge(b_, j);
      if (feature::vertex_edge(a_[i], e.from, e.to, gap) && nearer(gap))
        take({gap.squared, RationalPoint(a_[i]), along(e, gap.at_b, gap), corner(i), e.place});
    }
  for (std::size_t i = 0; i < edges_of(a_); ++i)
    for (std::size_t j = 0; j < b_.size(); ++j) {
      const Edge e = edge(a_, i);
      if (feature::vertex_edge(b_[j], e.from, e.to, gap) && nearer(gap))
        take({gap.squared, along(e, gap.at_b, gap), RationalPoint(b_[j]), e.place, corner(j)});
    }
}

void FeatureSearch::corners_faces() {
  FeatureDistance gap;
  for (std::size_t i = 0; b_.size() == 3 && i < a_.size(); ++i)
    if (feature::vertex_face(a_[i], triangle(b_), gap) && nearer(gap))
      take({gap.squared, RationalPoint(a_[i]), foot(a_[i], gap), corner(i), kFace});
  for (std::size_t j = 0; a_.size() == 3 && j < b_.size(); ++j)
    if (feature::vertex_face(b_[j], triangle(a_), gap) && nearer(gap))
      take({gap.squared, foot(b_[j], gap), RationalPoint(b_[j]), kFace, corner(j)});
}

void FeatureSearch::edges() {
  FeatureDistance gap;
  for (std::size_t i = 0; i < edges_of(a_); ++i)
    for (std::size_t j = 0; j < edges_of(b_); ++j) {
      const Edge e = edge(a_, i), f = edge(b_, j);
      if (feature::edge_edge(e.from, e.to, f.from, f.to, gap) && nearer(gap))
        take({gap.squared, along(e, gap.at_a, gap), along(f, gap.at_b, gap), e.place, f.place});
    }
}

void FeatureSearch::pierced() {
  FeatureDistance gap;
  for (std::size_t i = 0; b_.size() == 3 && i < edges_of(a_); ++i) {
    const Edge e = edge(a_, i);
    if (!feature::edge_face(e.from, e.to, triangle(b_), gap) || !nearer(gap)) continue;
    const RationalPoint p = along(e, gap.at_a, gap);
    take({gap.squared, p, p, e.place, kFace});
  }
  for (std::size_t j = 0; a_.size() == 3 && j < edges_of(b_); ++j) {
    const Edge e = edge(b_, j);
    if (!feature::edge_face(e.from, e.to, triangle(a_), gap) || !nearer(gap)) continue;
    const RationalPoint p = along(e, gap.at_a, gap);
    take({gap.squared, p, p, kFace, e.place});
  }
}

}  // namespace

ClosestPoints closest_points(const Vec3l& a, const Vec3l& b) {
  return FeatureSearch({&a, 1}, {&b, 1}).run();
}
ClosestPoints closest_points(const Vec3l& a, const Segment& b) {
  return FeatureSearch({&a, 1}, b).run();
}
ClosestPoints closest_points(const Vec3l& a, const TriangleCorners& b) {
  return FeatureSearch({&a, 1}, b).run();
}
ClosestPoints closest_points(const Segment& a, const Segment& b) {
  return FeatureSearch(a, b).run();
}
ClosestPoints closest_points(const Segment& a, const TriangleCorners& b) {
  return FeatureSearch(a, b).run();
}
ClosestPoints closest_points(const TriangleCorners& a, const TriangleCorners& b) {
  return FeatureSearch(a, b).run();
}

ClosestPoints closest_points(std::span<const Vec3l> a, std::span<const Vec3l> b) {
  assert(!a.empty() && a.size() <= 3 && !b.empty() && b.size() <= 3);
  return FeatureSearch(a, b).run();
}

ClosestOnBox closest_points(const Vec3l& p, const Box3l& box) {
  ClosestOnBox r;
  for (int k = 0; k < 3; ++k) {
    r.on_box[k] = std::clamp(p[k], box.lo[k], box.hi[k]);
    if (r.on_box[k] == box.lo[k]) r.place |= static_cast<BoxFeatureMask>(1U << (2 * k));
    if (r.on_box[k] == box.hi[k]) r.place |= static_cast<BoxFeatureMask>(2U << (2 * k));
  }
  r.squared = feature::vertex_vertex(p, r.on_box).squared;
  return r;
}

}  // namespace strake::geometry
