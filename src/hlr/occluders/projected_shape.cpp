// SPDX-License-Identifier: Apache-2.0
#include "hlr/occluders/projected_shape.hpp"

#include <algorithm>
#include <cstdlib>
#include <span>

#include "hlr/edges/element_loop.hpp"
#include "strake/geometry/part.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/slots.hpp"

namespace strake::hlr {
namespace {

Int128 facing_of(const geometry::Part& part, std::uint32_t t, const Viewer& viewer) {
  return viewer.facing(triangle_normal(part, t),
                       part.vertices[part.triangles[t][0]].as<std::int64_t>());
}

/// Returns whether some face of an exactly convex part looks towards the viewer.
bool is_outside(const geometry::Part& part, const Viewer& viewer) {
  if (!viewer.eye) return true;
  for (std::uint32_t t = 0; t < part.triangles.size(); ++t)
    if (facing_of(part, t, viewer) > 0) return true;
  return false;
}

// The viewer is outside. On the boundary of a convex body an edge of a face towards the viewer lies
// on the body's upper side, where nothing of the body is nearer; an edge between two faces turned
// away is behind the body all along. An edge with a face edge-on lies on the outline and may be
// behind on one side.
void classify_edges(const geometry::Part& part, const Viewer& viewer,
                    std::span<ProjectedEdge> edges) {
  for (ProjectedEdge& e : edges) {
    if (e.edge.part_edge == kNoPartEdge) continue;
    bool away = true, towards = false;
    for (const std::uint32_t t : geometry::incident_triangles(part, e.edge.part_edge)) {
      const Int128 facing = facing_of(part, t, viewer);
      away = away && facing < 0;
      towards = towards || facing > 0;
    }
    e.surely_behind_part = away && e.edge.away;
    e.surely_clear_of_part = towards;
  }
}

}  // namespace

Result<ProjectedShape> project_shape(const SectionedShape& sectioned,
                                     const ProjectionSettings& settings) {
  const model::GridShape& grid_shape = sectioned.shape();
  const Viewer& viewer = settings.features.viewer;
  ProjectedShape shape;
  shape.viewer = viewer;
  const auto found = sectioned_edges(sectioned, settings.features, settings.context);
  if (!found) return found.error();
  const std::vector<FeatureEdge>& edges = *found;
  auto on_paper = parallel::slots<ProjectedEdge>(edges.size(), settings.context);
  if (!on_paper) return on_paper.error();
  shape.edges = std::move(*on_paper);
  const Status placed = parallel::for_each(
      settings.context, over_elements("hidden lines: edges on paper", edges.size()),
      [&](std::size_t i) {
        ProjectedEdge& e = shape.edges[i];
        e.edge = edges[i];
        if (viewer.eye) return;
        e.a = settings.projection(e.edge.a.as<std::int64_t>());
        e.b = settings.projection(e.edge.b.as<std::int64_t>());
      });
  if (!placed) return placed.error();
  if (!settings.hides) return shape;

  std::size_t begin = 0;
  for (std::uint32_t p = 0; p < grid_shape.parts.size(); ++p) {
    std::size_t end = begin;
    while (end < edges.size() && edges[end].part == p) ++end;
    const geometry::Part& part = grid_shape.parts[p];
    const std::span<ProjectedEdge> own = std::span(shape.edges).subspan(begin, end - begin);
    begin = end;
    if (part.kind == geometry::PartKind::wire) continue;
    const Result<bool> convex = add_polygons(part, p, settings, own, shape);
    if (!convex) return convex.error();
    // A part that was rounded has a contact distance within itself, and some facets are edge-on but
    // for rounding: the signs account for neither.
    const bool exact =
        sectioned.within == 0 && (shape.parts.empty() || !shape.parts.back().edge_on);
    if (*convex && exact && is_outside(part, viewer)) classify_edges(part, viewer, own);
  }
  if (!shape.parts.empty()) shape.farthest = shape.parts.front().farthest;
  for (const OccluderPart& part : shape.parts) {
    shape.box.include(part.box);
    shape.farthest = std::min(shape.farthest, part.farthest);
    shape.deep_per_contact = std::max(shape.deep_per_contact, part.deep_per_contact);
  }
  if (!viewer.eye && !shape.box.empty())
    shape.reach = std::max({std::abs(shape.box.lo.u), std::abs(shape.box.hi.u),
                            std::abs(shape.box.lo.v), std::abs(shape.box.hi.v)});
  return shape;
}

}  // namespace strake::hlr
