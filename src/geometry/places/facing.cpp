// SPDX-License-Identifier: Apache-2.0
#include "geometry/places/facing.hpp"

#include <algorithm>

#include "geometry/analytic/convex_gap.hpp"
#include "geometry/hull_body.hpp"

namespace strake::geometry {
namespace {

/// Grid units: far above the rounding of a height, far below what matters.
constexpr double kMargin = 1.0 / 16;

std::vector<double> heights(const PartView& view, const Vec3d& n) {
  std::vector<double> all;
  all.reserve(view.part().vertices.size());
  for (std::uint32_t v = 0; v < view.part().vertices.size(); ++v)
    all.push_back(dot(n, view.vertex(v).as<double>()));
  return all;
}

/// The triangles with a corner no higher than a level.
std::vector<std::uint32_t> below(const PartView& view, const std::vector<double>& height,
                                 double level) {
  std::vector<std::uint32_t> low;
  const auto& triangles = view.part().triangles;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    if (std::ranges::any_of(triangles[t], [&](std::uint32_t v) { return height[v] <= level; }))
      low.push_back(t);
  return low;
}

}  // namespace

Facing facing(const PartView& a, const PartView& b, double reach) {
  const VertexTree none;
  const Vec3d n = analytic::convex_gap(hull_body(a.part(), none, a.shift().as<double>()),
                                       hull_body(b.part(), none, b.shift().as<double>()))
                      .normal;
  const std::vector<double> above = heights(a, n), under = heights(b, -n);
  // Two points within reach are no farther apart across the slab.
  const double margin = reach * (1 + 1e-12) + kMargin;
  Facing facing;
  facing.triangles_a = below(a, above, margin - *std::ranges::min_element(under));
  facing.triangles_b = below(b, under, margin - *std::ranges::min_element(above));
  std::vector<bool> listed(a.part().vertices.size(), false);
  for (const std::uint32_t t : facing.triangles_a)
    for (const std::uint32_t v : a.part().triangles[t]) listed[v] = true;
  for (std::uint32_t v = 0; v < listed.size(); ++v)
    if (listed[v]) facing.vertices_a.push_back(v);
  const auto& edges = a.part().edges;
  for (std::uint32_t e = 0; e + 1 < edges.size(); ++e)
    if (listed[edges[e].v0] && listed[edges[e].v1]) facing.edges_a.push_back(e);
  return facing;
}

}  // namespace strake::geometry
