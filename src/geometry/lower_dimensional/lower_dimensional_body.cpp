// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/lower_dimensional_body.hpp"

#include <cstddef>
#include <utility>

#include "geometry/primitive_pairs/shapes/torus.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::geometry {
namespace {

constexpr std::int64_t kWidestBody = std::int64_t{1} << 31;

/// Snapped points about the middle of their box; nothing where they have no place there.
struct Snapped {
  Vec3l origin;
  std::vector<Vec3i> points;
};

std::optional<Snapped> snap_all(std::span<const Vec3d> points) {
  std::vector<Vec3l> at;
  at.reserve(points.size());
  for (const Vec3d& p : points) {
    const auto q = snap(p);
    if (!q) return std::nullopt;
    at.push_back(*q);
  }
  if (at.empty()) return std::nullopt;
  Box3l box{at.front(), at.front()};
  for (const Vec3l& p : at) box.include(p);
  Snapped r;
  for (int k = 0; k < 3; ++k) {
    if (box.hi[k] - box.lo[k] >= kWidestBody) return std::nullopt;
    r.origin[k] = box.lo[k] + (box.hi[k] - box.lo[k]) / 2;
  }
  r.points.reserve(at.size());
  for (const Vec3l& p : at) r.points.push_back((p - r.origin).as<std::int32_t>());
  return r;
}

/// Adds the segments of a chain of vertices that are not repeated.
void add_chain(LowerDimensionalBody& body, std::uint32_t first, std::uint32_t end, bool closed) {
  if (end - first == 1) body.points.push_back(first);
  for (std::uint32_t i = first; i + 1 < end; ++i) body.segments.push_back({i, i + 1});
  if (closed && end - first > 2) body.segments.push_back({end - 1, first});
}

}  // namespace

std::optional<LowerDimensionalBody> make_point_body(const Vec3d& p) {
  return make_polyline_body({&p, 1});
}

std::optional<LowerDimensionalBody> make_polyline_body(std::span<const Vec3d> points, bool closed) {
  const auto snapped = snap_all(points);
  if (!snapped) return std::nullopt;
  LowerDimensionalBody body;
  body.origin = snapped->origin;
  for (const Vec3i& p : snapped->points)
    if (body.vertices.empty() || body.vertices.back() != p) body.vertices.push_back(p);
  if (closed && body.vertices.size() > 1 && body.vertices.back() == body.vertices.front())
    body.vertices.pop_back();
  add_chain(body, 0, static_cast<std::uint32_t>(body.vertices.size()), closed);
  return body;
}

PolygonBody make_polygon_body(std::span<const Vec3d> points, std::span<const std::uint32_t> first) {
  PolygonBody r;
  FaceTriangles face = triangulate_face(points, first);
  r.fault = face.fault;
  if (r.fault != FaceFault::none) return r;
  const auto snapped = snap_all(points);
  if (!snapped) {
    r.fault = FaceFault::not_finite;
    return r;
  }
  r.body.origin = snapped->origin;
  r.body.vertices = snapped->points;
  r.body.triangles = std::move(face.triangles);
  return r;
}

std::optional<LowerDimensionalBody> make_arc_body(const CircularArc& arc) {
  const auto centre = snap(arc.placement.translation);
  if (!centre) return std::nullopt;
  const auto line = primitive_pairs::Torus::of(arc, *centre);
  if (!line || !(2 * line->radius() < static_cast<double>(kWidestBody))) return std::nullopt;
  LowerDimensionalBody body;
  body.origin = *centre;
  body.arcs.push_back(arc);
  return body;
}

LowerDimensionalBody make_wire_body(const PlacedPart& wire) {
  LowerDimensionalBody body;
  body.origin = wire.origin;
  body.vertices = wire.part->vertices;
  const std::vector<std::uint32_t>& first = wire.part->chain_first;
  for (std::size_t c = 0; c + 1 < first.size(); ++c) add_chain(body, first[c], first[c + 1], false);
  return body;
}

}  // namespace strake::geometry
