// SPDX-License-Identifier: Apache-2.0
#include "geometry/depth/boundary_curve.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

#include "strake/geometry/part_edges.hpp"
#include "strake/geometry/predicates.hpp"

namespace strake::geometry {
namespace {

/// Whether two triangles with a common edge lie on different sides of it, and not on each other.
bool go_on(const Part& part, const PartEdge& edge, std::uint32_t t, std::uint32_t u) {
  const auto at = [&](std::uint32_t v) { return part.vertices[v].as<std::int64_t>(); };
  const Vec3l from = at(edge.v0), to = at(edge.v1);
  const Vec3l p = at(corner_off(part.triangles[t], edge)),
              q = at(corner_off(part.triangles[u], edge));
  if (orient3d(from, to, p, q) != 0) return true;
  return dot(cross_exact(to - from, p - from).as<double>(),
             cross_exact(to - from, q - from).as<double>()) < 0;
}

/// Whether the triangles round an edge do not cancel in direction. Two that do not may be those of
/// one face that is wound to and fro.
bool ends_at(const Part& part, std::uint32_t number) {
  const PartEdge& edge = part.edges[number];
  const std::span<const std::uint32_t> round = triangles_round(part, number);
  int balance = 0;
  for (const std::uint32_t t : round)
    balance += runs_along(part.triangles[t], edge.v0, edge.v1) ? 1 : -1;
  return balance != 0 && !(round.size() == 2 && go_on(part, edge, round[0], round[1]));
}

}  // namespace

std::vector<std::array<Vec3d, 2>> boundary_curve(const Part& part) {
  std::vector<std::array<Vec3d, 2>> curve;
  for (std::uint32_t e = 0; e + 1 < part.edges.size(); ++e)
    if (ends_at(part, e))
      curve.push_back({part.vertices[part.edges[e].v0].as<double>(),
                       part.vertices[part.edges[e].v1].as<double>()});
  return curve;
}

}  // namespace strake::geometry
