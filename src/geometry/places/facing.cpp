// SPDX-License-Identifier: Apache-2.0
#include "geometry/places/facing.hpp"

#include "geometry/analytic/convex_gap.hpp"
#include "geometry/hull_body.hpp"

namespace strake::geometry {

SlabHeights slab_heights(const PartView& a, const PartView& b, double reach) {
  const VertexTree none;
  const Vec3d n = analytic::convex_gap(hull_body(a.part(), none, a.shift().as<double>()),
                                       hull_body(b.part(), none, b.shift().as<double>()))
                      .normal;
  return {a, b, n, reach};
}

Facing facing(const PartView& a, const PartView& b, double reach) {
  Facing facing{.heights = slab_heights(a, b, reach)};
  const SlabHeights& heights = facing.heights;
  facing.triangles_a = heights.a.below(heights.level_a);
  facing.triangles_b = heights.b.below(heights.level_b);
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
