// SPDX-License-Identifier: Apache-2.0
#include "hlr/shape_view.hpp"

#include <algorithm>
#include <cstdlib>

#include "strake/geometry/part_edges.hpp"

namespace strake::hlr {
namespace {

// On the boundary of a convex body an edge of a face towards the viewer lies on the body's upper
// side, where nothing of the body is nearer; an edge between two faces turned away is behind the
// body all along. One with a face edge-on lies on the outline and may be behind on one side.
void judge_edges(const geometry::Part& part, const geometry::Vec3l& direction,
                 std::span<EdgeView> edges) {
  for (EdgeView& e : edges) {
    if (e.edge.part_edge == kNoPartEdge) continue;
    bool away = true, towards = false;
    for (const std::uint32_t t : geometry::triangles_round(part, e.edge.part_edge)) {
      const Int128 facing = along(triangle_normal(part, t), direction);
      away = away && facing < 0;
      towards = towards || facing > 0;
    }
    e.surely_behind_part = away;
    e.surely_clear_of_part = towards;
  }
}

}  // namespace

ShapeView view_of(const SeenShape& seen, const Frame& frame, const FeatureOptions& options) {
  const model::GridShape& shape = seen.shape();
  ShapeView view;
  view.direction = options.direction;
  const std::vector<FeatureEdge> edges = edges_of(seen, options);
  view.edges.reserve(edges.size());
  for (const FeatureEdge& e : edges)
    view.edges.push_back({e, frame(e.a.as<std::int64_t>()), frame(e.b.as<std::int64_t>())});

  std::size_t begin = 0;
  for (std::uint32_t p = 0; p < shape.parts.size(); ++p) {
    std::size_t end = begin;
    while (end < edges.size() && edges[end].part == p) ++end;
    const geometry::Part& part = shape.parts[p];
    // What was rounded has a contact distance within the part, which the signs know nothing of.
    if (part.kind != geometry::PartKind::wire && add_polygons(part, p, frame, view) &&
        seen.within == 0)
      judge_edges(part, options.direction, std::span(view.edges).subspan(begin, end - begin));
    begin = end;
  }
  for (const PartView& part : view.parts) view.box.include(part.box);
  for (const Corner& c : view.corners)
    view.reach = std::max({view.reach, std::abs(c.u), std::abs(c.v)});
  return view;
}

}  // namespace strake::hlr
