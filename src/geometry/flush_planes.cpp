// SPDX-License-Identifier: Apache-2.0
#include "geometry/flush_planes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>

#include "strake/geometry/part_edges.hpp"
#include "strake/geometry/predicates.hpp"

namespace strake::geometry {
namespace {

/// Fewer triangles in a plane are walked as quickly, and more planes are not looked at.
constexpr std::size_t kFewest = 16, kMostPlanes = 8;
/// Least share of all pairs of triangles that has to lie in the planes, as a divisor.
constexpr std::size_t kShare = 64;

/// A triangle in a coordinate plane.
struct Lying {
  int axis = 0;
  std::int64_t height = 0;
  std::uint32_t triangle = 0;
  bool along = false;  ///< it looks along the axis

  [[nodiscard]] auto plane() const { return std::tie(axis, height); }
};

std::vector<Lying> lying(const PartView& view) {
  std::vector<Lying> all;
  for (std::uint32_t t = 0; t < view.part().triangles.size(); ++t) {
    const auto c = view.corners(t);
    for (int k = 0; k < 3; ++k) {
      if (c[0][k] != c[1][k] || c[0][k] != c[2][k]) continue;
      all.push_back({k, c[0][k], t, orient2d(c[0], c[1], c[2], k) > 0});
    }
  }
  std::ranges::sort(all, [](const Lying& p, const Lying& q) {
    return std::tie(p.axis, p.height, p.triangle) < std::tie(q.axis, q.height, q.triangle);
  });
  return all;
}

/// Of a part: the triangles of each plane, if many and all facing one way.
struct PlaneFaces {
  const Lying* first = nullptr;
  std::vector<std::uint32_t> triangles;
};

std::vector<PlaneFaces> faces_of(const std::vector<Lying>& all) {
  std::vector<PlaneFaces> faces;
  for (auto from = all.begin(); from != all.end();) {
    const auto to =
        std::find_if(from, all.end(), [&](const Lying& l) { return l.plane() != from->plane(); });
    const bool one_way =
        std::all_of(from, to, [&](const Lying& l) { return l.along == from->along; });
    if (one_way && static_cast<std::size_t>(to - from) >= kFewest) {
      PlaneFaces& plane = faces.emplace_back();
      plane.first = &*from;
      for (auto l = from; l != to; ++l) plane.triangles.push_back(l->triangle);
    }
    from = to;
  }
  return faces;
}

std::vector<std::uint32_t> through(const PartView& view, const FlushPlane& plane,
                                   const std::vector<std::uint32_t>& in_plane) {
  const Part& part = view.part();
  const std::int64_t height = plane.height - view.shift()[plane.axis];
  const auto lies = [&](std::uint32_t t) { return std::ranges::binary_search(in_plane, t); };
  std::vector<std::uint32_t> others;
  for (std::uint32_t t = 0; t < part.triangles.size(); ++t) {
    const Triangle& c = part.triangles[t];
    int above = 0, below = 0;
    std::array<std::uint32_t, 3> on{};
    std::size_t count = 0;
    for (const std::uint32_t v : c) {
      const std::int64_t at = part.vertices[v][plane.axis];
      if (at > height)
        ++above;
      else if (at < height)
        ++below;
      else
        on[count++] = v;
    }
    const auto on_rim = [&] {
      const auto round = triangles_round(part, edge_between(part, on[0], on[1]));
      return std::ranges::any_of(round, lies);
    };
    if ((above > 0 && below > 0) || (count == 2 && !on_rim())) others.push_back(t);
  }
  return others;
}

}  // namespace

std::vector<FlushPlane> flush_planes(const PartView& a, const PartView& b) {
  const std::vector<Lying> lying_a = lying(a), lying_b = lying(b);
  const std::vector<PlaneFaces> faces_a = faces_of(lying_a), faces_b = faces_of(lying_b);
  std::vector<FlushPlane> planes;
  for (auto x = faces_a.begin(), y = faces_b.begin(); x != faces_a.end() && y != faces_b.end();) {
    const auto of_x = x->first->plane(), of_y = y->first->plane();
    if (of_x == of_y)
      planes.push_back({x->first->axis, x->first->height, x->triangles, y->triangles, {}, {}});
    if (of_x <= of_y) ++x;
    if (of_y <= of_x) ++y;
  }
  const auto pairs = [](const FlushPlane& p) { return p.a.size() * p.b.size(); };
  std::ranges::sort(planes, [&](const FlushPlane& p, const FlushPlane& q) {
    return std::tuple(pairs(q), p.axis, p.height) < std::tuple(pairs(p), q.axis, q.height);
  });
  if (planes.size() > kMostPlanes) planes.resize(kMostPlanes);
  std::size_t all = 0;
  for (const FlushPlane& plane : planes) all += pairs(plane);
  if (all < a.part().triangles.size() * b.part().triangles.size() / kShare) return {};
  for (FlushPlane& plane : planes) {
    plane.through_a = through(a, plane, plane.a);
    plane.through_b = through(b, plane, plane.b);
  }
  return planes;
}

}  // namespace strake::geometry
