// SPDX-License-Identifier: Apache-2.0
#include "geometry/places/flat_end.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/corners.hpp"
#include "geometry/directions.hpp"
#include "strake/core/disjoint_sets.hpp"
#include "strake/geometry/part_edges.hpp"

namespace strake::geometry {
namespace {

/// The cosine of the flattest angle between a wall and the plane.
constexpr double kSteep = 0.7;

double turn(const Flat& o, const Flat& p, const Flat& q) {
  return (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
}

struct Hull {
  double area = 0;  ///< twice
  double rim = 0;
};

/// Of the convex hull, by Andrew's monotone chain.
template <std::size_t kMost>
Hull hull_of(std::span<const Flat> corners) {
  std::array<Flat, kMost> sorted;
  const std::span<Flat> points = std::span(sorted).first(corners.size());
  std::ranges::copy(corners, points.begin());
  std::ranges::sort(
      points, [](const Flat& p, const Flat& q) { return p.x != q.x ? p.x < q.x : p.y < q.y; });
  std::array<Flat, 2 * kMost> chain;
  std::size_t size = 0;
  for (int side = 0; side < 2; ++side) {
    const std::size_t start = size;
    for (const Flat& p : points) {
      while (size >= start + 2 && turn(chain[size - 2], chain[size - 1], p) <= 0) --size;
      chain[size++] = p;
    }
    --size;
    std::ranges::reverse(points);
  }
  Hull hull;
  for (std::size_t i = 0; i < size; ++i) {
    const Flat &p = chain[i], &q = chain[(i + 1) % size];
    hull.area += turn(chain[0], p, q);
    hull.rim += std::hypot(q.x - p.x, q.y - p.y);
  }
  return hull;
}

}  // namespace

FlatPlane::FlatPlane(const Vec3d& axis, const FlatReach& near)
    : FlatReach(near), u(square_to(axis)), w(cross(axis, u)) {}

std::optional<FlatEnd> FlatEnd::of(const Side& side, const FlatPlane& plane) {
  std::optional<FlatEnd> end(std::in_place, side, plane);
  if (!end->gather(side) || !end->add_faces(side.way)) end.reset();
  return end;
}

bool FlatEnd::gather(const Side& side) {
  for (std::size_t v = 0; v < part_.vertices.size(); ++v) {
    const Vec3d p = part_.vertices[v].as<double>();
    const double at = dot(side.way, p);
    if (at >= side.top - plane_.band) {
      if (count_ == kMostCorners) return false;
      corners_[count_++] = plane_.put(p + shift_);
      at_top_[v] = 1;
    } else if (at >= side.top - plane_.reach - 2 * plane_.band) {
      return false;
    }
  }
  return count_ >= 3;
}

bool FlatEnd::add_faces(const Vec3d& way) {
  for (const Triangle& t : part_.triangles) {
    const int at_the_top = at_top_[t[0]] + at_top_[t[1]] + at_top_[t[2]];
    if (at_the_top == 0) continue;
    const Vec3d n = normal_of(corners_of(part_, t));
    if (at_the_top == 3)
      area_ += dot(n, way);
    else if (std::fabs(dot(n, way)) > kSteep * std::sqrt(dot(n, n)))
      return false;
  }
  area_ = std::fabs(area_);
  return true;
}

bool FlatEnd::is_convex() const {
  const Hull hull = hull_of<kMostCorners>(std::span(corners_).first(count_));
  // Neither area nor rim alone tells: a hole is small beside what the rim of a large plate leaves
  // open, and a notch adds little to the rim. Nor do both of two feet: of small ones that stand
  // near each other the rim of the two is that of one.
  const double open = hull.area - area_;
  if (open > 2 * plane_.band * hull.rim) return false;
  if (open > 2 * FlatReach::kSnap * hull.rim && !is_one_face()) return false;
  double rim = 0;
  for (std::uint32_t e = 0; e + 1 < part_.edges.size(); ++e) {
    if (only_face(e) == nullptr) continue;
    const PartEdge& edge = part_.edges[e];
    rim += length((part_.vertices[edge.v1] - part_.vertices[edge.v0]).as<double>());
  }
  return rim <= hull.rim + plane_.reach;
}

const Triangle* FlatEnd::only_face(std::uint32_t edge) const {
  const PartEdge& e = part_.edges[edge];
  if (at_top_[e.v0] == 0 || at_top_[e.v1] == 0) return nullptr;
  const Triangle* only = nullptr;
  for (const std::uint32_t t : triangles_round(part_, edge)) {
    if (!lies_in_plane(part_.triangles[t])) continue;
    if (only != nullptr) return nullptr;
    only = &part_.triangles[t];
  }
  return only;
}

std::vector<FlatEnd::RimEdge> FlatEnd::rim() const {
  std::vector<RimEdge> rim;
  const auto put = [&](std::uint32_t v) {
    return plane_.put(part_.vertices[v].as<double>() + shift_);
  };
  for (std::uint32_t e = 0; e + 1 < part_.edges.size(); ++e) {
    const Triangle* face = only_face(e);
    if (face == nullptr) continue;
    const PartEdge& edge = part_.edges[e];
    const std::uint32_t third = (*face)[0] ^ (*face)[1] ^ (*face)[2] ^ edge.v0 ^ edge.v1;
    const Flat from = put(edge.v0), to = put(edge.v1);
    const double sign = turn(from, to, put(third)) < 0 ? -1 : 1;
    rim.push_back({edge.v0, edge.v1, from, to, {sign * (from.y - to.y), sign * (to.x - from.x)}});
  }
  return rim;
}

bool FlatEnd::is_one_face() const {
  DisjointSets sets;
  sets.reset(part_.triangles.size());
  std::vector<std::uint8_t> covered(part_.vertices.size(), 0);
  std::size_t faces = 0;
  for (const Triangle& t : part_.triangles) {
    if (!lies_in_plane(t)) continue;
    ++faces;
    for (const std::uint32_t v : t) covered[v] = 1;
  }
  if (faces == 0 || covered != at_top_) return false;
  for (std::uint32_t e = 0; e + 1 < part_.edges.size(); ++e) {
    std::optional<std::uint32_t> first;
    for (const std::uint32_t t : triangles_round(part_, e)) {
      if (!lies_in_plane(part_.triangles[t])) continue;
      if (first) sets.join(*first, t);
      first = first.value_or(t);
    }
  }
  return sets.count() == part_.triangles.size() - faces + 1;
}

}  // namespace strake::geometry
