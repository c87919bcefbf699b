// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/triangulate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "geometry/triangulation/constrained_delaunay.hpp"

namespace strake::geometry {
namespace {

using triangulation::Point2;

/// Points about the middle of their box, in units of a power of two.
struct Integers {
  std::vector<Vec3l> points;
  bool finite = true;
};

Integers to_integers(std::span<const Vec3d> points) {
  Integers result;
  Box3d box = empty_box<double>();
  for (const Vec3d& p : points) {
    // A sum tells of anything that is not finite; halves keep it from overflowing.
    if (!std::isfinite(p.x / 4 + p.y / 4 + p.z / 4)) return {{}, false};
    box.include(p);
  }
  double extent = 0;
  Vec3d middle;
  for (int k = 0; k < 3; ++k) {
    middle[k] = box.lo[k] / 2 + box.hi[k] / 2;
    extent = std::max(extent, box.hi[k] / 2 - box.lo[k] / 2);
  }
  int exponent = 0;
  (void)std::frexp(extent, &exponent);  // extent < 2^exponent
  result.points.reserve(points.size());
  for (const Vec3d& p : points) {
    Vec3l integer;
    for (int k = 0; k < 3; ++k) {
      const double scaled = std::ldexp(p[k] - middle[k], 28 - exponent);
      integer[k] = static_cast<std::int64_t>(scaled + (scaled < 0 ? -0.5 : 0.5));
    }
    result.points.push_back(integer);
  }
  return result;
}

/// Twice the area vector of a closed contour, exact.
std::array<__int128, 3> area_vector(std::span<const Vec3l> contour) {
  std::array<__int128, 3> area{};
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const Vec3l &a = contour[i], &b = contour[i + 1 == contour.size() ? 0 : i + 1];
    area[0] += static_cast<__int128>(a.y) * b.z - static_cast<__int128>(a.z) * b.y;
    area[1] += static_cast<__int128>(a.z) * b.x - static_cast<__int128>(a.x) * b.z;
    area[2] += static_cast<__int128>(a.x) * b.y - static_cast<__int128>(a.y) * b.x;
  }
  return area;
}

/// The two axes that remain, in the order that makes the contour counter-clockwise.
struct Projection {
  int u = 0, v = 1;
  bool has_area = false;
};

Projection choose_projection(std::span<const Vec3l> contour) {
  const auto area = area_vector(contour);
  const auto size = [&](std::size_t k) { return area[k] < 0 ? -area[k] : area[k]; };
  std::size_t largest = 2;
  if (size(1) > size(largest)) largest = 1;
  if (size(0) > size(largest)) largest = 0;
  if (area[largest] == 0) return {};
  Projection p{static_cast<int>((largest + 1) % 3), static_cast<int>((largest + 2) % 3), true};
  if (area[largest] < 0) std::swap(p.u, p.v);
  return p;
}

/// Distinct projected points, ascending, with one source point each.
struct Distinct {
  std::vector<Point2> points;
  std::vector<std::uint32_t> source;      ///< of each distinct point
  std::vector<std::uint32_t> renumbered;  ///< of each source point
  bool ambiguous = false;                 ///< two points differ along the projection only
};

Distinct find_distinct(const std::vector<Vec3l>& points, const Projection& projection) {
  Distinct d;
  const auto flat = [&](std::uint32_t i) {
    return Point2{points[i][projection.u], points[i][projection.v]};
  };
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto p = flat(a), q = flat(b);
    return p != q ? p < q : a < b;
  });
  d.renumbered.resize(points.size());
  for (const std::uint32_t i : order) {
    if (d.points.empty() || d.points.back() != flat(i)) {
      d.points.push_back(flat(i));
      d.source.push_back(i);
    } else if (points[d.source.back()] != points[i]) {
      d.ambiguous = true;
    }
    d.renumbered[i] = static_cast<std::uint32_t>(d.points.size() - 1);
  }
  return d;
}

/// Ranges of the contours, cut to the points that there are.
std::vector<std::pair<std::size_t, std::size_t>> ranges(std::span<const std::uint32_t> first,
                                                        std::size_t points) {
  std::vector<std::pair<std::size_t, std::size_t>> list;
  for (std::size_t c = 0; c + 1 < first.size(); ++c) {
    const std::size_t end = std::min<std::size_t>(first[c + 1], points);
    if (first[c] < end) list.emplace_back(first[c], end);
  }
  return list;
}

using Segment = std::pair<std::size_t, std::size_t>;

std::vector<Segment> segments(const std::vector<std::pair<std::size_t, std::size_t>>& contours) {
  std::vector<Segment> list;
  for (const auto& [begin, end] : contours)
    for (std::size_t i = begin; i < end; ++i) list.emplace_back(i, i + 1 == end ? begin : i + 1);
  return list;
}

/// The segments in the order of their numbers' bits read backwards: early ones part the face into
/// pieces of like size, so that later ones cross few edges. One after the other along a contour of
/// slanted teeth each would cross nearly all.
std::vector<Segment> scattered(const std::vector<Segment>& list) {
  std::size_t size = 1;
  while (size < list.size()) size *= 2;
  std::vector<Segment> out;
  out.reserve(list.size());
  std::size_t turned = 0;
  for (std::size_t i = 0; i < size; ++i) {
    if (turned < list.size()) out.push_back(list[turned]);
    std::size_t bit = size / 2;  // count up from the other end
    while (bit > 0 && (turned & bit) != 0) {
      turned ^= bit;
      bit /= 2;
    }
    turned |= bit;
  }
  return out;
}

}  // namespace

std::string_view describe(FaceFault fault) {
  switch (fault) {
    case FaceFault::none:
      return "";
    case FaceFault::not_finite:
      return "a coordinate is not a finite number";
    case FaceFault::no_area:
      return "the outline encloses nothing";
    case FaceFault::crossing:
      return "contours cross";
  }
  return "";
}

FaceTriangles triangulate_face(std::span<const Vec3d> points,
                               std::span<const std::uint32_t> first) {
  const auto contours = ranges(first, points.size());
  const Integers integers = to_integers(points);
  if (!integers.finite) return {{}, FaceFault::not_finite};
  if (contours.empty()) return {{}, FaceFault::no_area};
  const Projection projection =
      choose_projection(std::span(integers.points)
                            .subspan(contours[0].first, contours[0].second - contours[0].first));
  if (!projection.has_area) return {{}, FaceFault::no_area};
  const Distinct distinct = find_distinct(integers.points, projection);
  if (distinct.ambiguous) return {{}, FaceFault::crossing};
  triangulation::ConstrainedDelaunay mesh(distinct.points);
  for (const auto& [from, to] : scattered(segments(contours)))
    if (!mesh.insert_constraint(distinct.renumbered[from], distinct.renumbered[to]))
      return {{}, FaceFault::crossing};
  mesh.restore_delaunay();
  const std::vector<bool> inside = mesh.inside();
  FaceTriangles result;
  for (std::size_t c = 0; c < inside.size(); ++c) {
    if (!inside[c]) continue;
    const auto& v = mesh.cells()[c].vertex;
    result.triangles.push_back(
        {distinct.source[v[0]], distinct.source[v[1]], distinct.source[v[2]]});
  }
  if (result.triangles.empty()) result.fault = FaceFault::no_area;
  return result;
}

FaceTriangles triangulate_face(std::span<const Vec3d> contour) {
  const std::array<std::uint32_t, 2> first{0, static_cast<std::uint32_t>(contour.size())};
  return triangulate_face(contour, first);
}

}  // namespace strake::geometry
