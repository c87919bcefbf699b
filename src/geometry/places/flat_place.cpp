// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "geometry/corners.hpp"
#include "geometry/directions.hpp"
#include "strake/geometry/meeting_places.hpp"
#include "strake/geometry/part_edges.hpp"

// Two convex faces in one plane have one convex polygon in common. What else of either body comes
// within reach of the plane is a collar round its face; it leaves the plane steeply, so that it
// adds no more than a rim about as wide as the reach.

namespace strake::geometry {
namespace {

/// What counts as in one plane: the share of the reach, and in grid units what the snap may have
/// moved.
constexpr double kShare = 0.05, kSnap = 4;
/// The cosine of the flattest angle between a collar and the plane.
constexpr double kSteep = 0.7;
/// Faces with more corners are left to others.
constexpr std::size_t kMostCorners = 512;

struct Flat {
  double x = 0, y = 0;
};

double turn(const Flat& o, const Flat& p, const Flat& q) {
  return (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
}

struct Hull {
  double area = 0;  ///< twice
  double rim = 0;
};

/// Of the convex hull, by Andrew's monotone chain.
Hull hull_of(std::span<Flat> points) {
  std::ranges::sort(
      points, [](const Flat& p, const Flat& q) { return p.x != q.x ? p.x < q.x : p.y < q.y; });
  std::array<Flat, 2 * kMostCorners> chain;
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

/// A part, a direction out of it, and how far it reaches that way.
struct Side {
  const Part& part;
  Vec3d way;
  double top = 0;

  /// Whether what of the part is within `reach` of its top is one convex face, and a steep collar.
  [[nodiscard]] bool ends_in_one_face(double reach, double band) const {
    const Vec3d u = square_to(way), w = cross(way, u);
    std::array<Flat, kMostCorners> corners;
    std::size_t count = 0;
    std::vector<std::uint8_t> at_top(part.vertices.size(), 0);
    for (std::size_t v = 0; v < part.vertices.size(); ++v) {
      const Vec3d p = part.vertices[v].as<double>();
      const double at = dot(way, p);
      if (at >= top - band) {
        if (count == kMostCorners) return false;
        corners[count++] = {dot(u, p), dot(w, p)};
        at_top[v] = 1;
      } else if (at >= top - reach - 2 * band) {
        return false;
      }
    }
    if (count < 3) return false;
    const std::optional<double> area = face_area(at_top);
    if (!area) return false;
    const Hull hull = hull_of(std::span(corners).first(count));
    // Neither area nor rim alone tells: a hole is small beside what the rim of a large plate leaves
    // open, and a notch adds little to the rim.
    return *area >= hull.area - 2 * band * hull.rim && face_rim(at_top) <= hull.rim + reach;
  }

 private:
  /// Twice the area of the triangles at the top; nothing where others leave it at a flat angle.
  /// `at_top`: by vertex.
  [[nodiscard]] std::optional<double> face_area(const std::vector<std::uint8_t>& at_top) const {
    double area = 0;
    for (const Triangle& t : part.triangles) {
      const int at_the_top = at_top[t[0]] + at_top[t[1]] + at_top[t[2]];
      if (at_the_top == 0) continue;
      const Vec3d n = normal_of(corners_of(part, t));
      if (at_the_top == 3)
        area += dot(n, way);
      else if (std::fabs(dot(n, way)) > kSteep * std::sqrt(dot(n, n)))
        return std::nullopt;
    }
    return std::fabs(area);
  }

  /// The length of all edges that bound the triangles at the top, round holes too.
  [[nodiscard]] double face_rim(const std::vector<std::uint8_t>& at_top) const {
    double rim = 0;
    for (std::uint32_t e = 0; e + 1 < part.edges.size(); ++e) {
      const PartEdge& edge = part.edges[e];
      if (at_top[edge.v0] == 0 || at_top[edge.v1] == 0) continue;
      int faces = 0;
      for (const std::uint32_t t : triangles_round(part, e)) {
        const Triangle& c = part.triangles[t];
        faces += at_top[c[0]] + at_top[c[1]] + at_top[c[2]] == 3 ? 1 : 0;
      }
      if (faces == 1)
        rim += length(part.vertices[edge.v1].as<double>() - part.vertices[edge.v0].as<double>());
    }
    return rim;
  }
};

/// Both sides of a plane, or nothing where none of this direction is between the two.
bool face_to_face(const Side& x, const Side& y, const Vec3d& shift, double reach) {
  const double gap = dot(x.way, shift) - y.top - x.top;
  const double band = std::max(kSnap, kShare * reach);
  return gap >= -band && gap <= reach && x.ends_in_one_face(reach, band) &&
         y.ends_in_one_face(reach, band);
}

double top_along(const Part& part, const Vec3d& way) {
  double top = -std::numeric_limits<double>::infinity();
  for (const Vec3i& v : part.vertices) top = std::max(top, dot(way, v.as<double>()));
  return top;
}

/// By the axes of the first one's frame; `shift` takes the other's coordinates to the first one's.
bool along_frame(const FramedPart& of, const Part& other, const Vec3d& shift, double reach) {
  if (of.frame == nullptr) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d& axis = of.frame->axis[i];
    if (!(dot(axis, axis) > 0)) continue;  // a frame that was not made
    for (const double sign : {1.0, -1.0}) {
      const Vec3d way = axis * sign;
      const Side own{*of.placed.part, way, sign > 0 ? of.frame->hi[i] : -of.frame->lo[i]};
      if (face_to_face(own, {other, -way, top_along(other, -way)}, shift, reach)) return true;
    }
  }
  return false;
}

}  // namespace

bool in_one_flat_place(const FramedPart& a, const FramedPart& b, double reach) {
  const Part &x = *a.placed.part, &y = *b.placed.part;
  // Looking at each vertex would cost more than telling the places by a tree.
  if (std::max(x.vertices.size(), y.vertices.size()) >= kManyVertices) return false;
  const Vec3d shift = (b.placed.origin - a.placed.origin).as<double>();
  for (int k = 0; k < 3; ++k)
    for (const double sign : {1.0, -1.0}) {
      Vec3d way;
      way[k] = sign;
      const Side of_a{x, way, sign > 0 ? x.box.hi[k] : -static_cast<double>(x.box.lo[k])};
      const Side of_b{y, -way, sign > 0 ? -static_cast<double>(y.box.lo[k]) : y.box.hi[k]};
      if (face_to_face(of_a, of_b, shift, reach)) return true;
    }
  return along_frame(a, y, shift, reach) || along_frame(b, x, -shift, reach);
}

}  // namespace strake::geometry
