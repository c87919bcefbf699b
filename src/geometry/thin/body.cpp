// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <utility>

#include "geometry/analytic/torus.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/geometry/thin_body.hpp"

namespace strake::geometry {
namespace {

constexpr std::int64_t kWidest = std::int64_t{1} << 31;

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
    if (box.hi[k] - box.lo[k] >= kWidest) return std::nullopt;
    r.origin[k] = box.lo[k] + (box.hi[k] - box.lo[k]) / 2;
  }
  r.points.reserve(at.size());
  for (const Vec3l& p : at) r.points.push_back((p - r.origin).as<std::int32_t>());
  return r;
}

/// Adds the segments of a chain of vertices that are not repeated.
void add_chain(ThinBody& body, std::uint32_t first, std::uint32_t end, bool closed) {
  if (end - first == 1) body.points.push_back(first);
  for (std::uint32_t i = first; i + 1 < end; ++i) body.segments.push_back({i, i + 1});
  if (closed && end - first > 2) body.segments.push_back({end - 1, first});
}

}  // namespace

std::optional<ThinBody> thin_point(const Vec3d& p) { return thin_polyline({&p, 1}); }

std::optional<ThinBody> thin_polyline(std::span<const Vec3d> points, bool closed) {
  const auto snapped = snap_all(points);
  if (!snapped) return std::nullopt;
  ThinBody body;
  body.origin = snapped->origin;
  for (const Vec3i& p : snapped->points)
    if (body.vertices.empty() || body.vertices.back() != p) body.vertices.push_back(p);
  if (closed && body.vertices.size() > 1 && body.vertices.back() == body.vertices.front())
    body.vertices.pop_back();
  add_chain(body, 0, static_cast<std::uint32_t>(body.vertices.size()), closed);
  return body;
}

ThinPolygon thin_polygon(std::span<const Vec3d> points, std::span<const std::uint32_t> first) {
  ThinPolygon r;
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

std::optional<ThinBody> thin_arc(const ThinArc& arc) {
  const auto centre = snap(arc.placement.translation);
  if (!centre) return std::nullopt;
  const auto line = analytic::Torus::of(arc, *centre);
  if (!line || !(2 * line->radius() < static_cast<double>(kWidest))) return std::nullopt;
  ThinBody body;
  body.origin = *centre;
  body.arcs.push_back(arc);
  return body;
}

ThinBody thin_wire(const PlacedPart& wire) {
  ThinBody body;
  body.origin = wire.origin;
  body.vertices = wire.part->vertices;
  const std::vector<std::uint32_t>& first = wire.part->chain_first;
  for (std::size_t c = 0; c + 1 < first.size(); ++c) add_chain(body, first[c], first[c + 1], false);
  return body;
}

}  // namespace strake::geometry
