// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/tessellate.hpp"

#include <cmath>
#include <utility>

#include "geometry/tessellate/build.hpp"
#include "strake/geometry/place.hpp"

namespace strake::geometry {
namespace {

/// What int32 can span on the grid, with room for the bound's own slack.
constexpr double kWidestMm = 4e6;

/// False when a length of the primitive is so large that tessellating it is a waste.
bool fits(const Tessellation& t) {
  for (const Vec3d& v : t.mesh.vertices)
    if (!(std::fabs(v.x) < kWidestMm) || !(std::fabs(v.y) < kWidestMm) ||
        !(std::fabs(v.z) < kWidestMm))
      return false;
  return true;
}

/// The direction that a map takes to the given one, up to its length: where local normals are at
/// right angles to it, placed ones are to the given one. None where the map flattens it.
std::optional<Vec3d> local_direction(const Mat3d& linear, const Vec3d& placed) {
  using tessellation::column;
  const Vec3d x = column(linear, 0), y = column(linear, 1), z = column(linear, 2);
  const Vec3d local{dot(cross(y, z), placed), dot(cross(z, x), placed), dot(cross(x, y), placed)};
  const double square = dot(local, local);
  if (!(square > 0) || !std::isfinite(square)) return std::nullopt;
  return local * (1 / std::sqrt(square));
}

}  // namespace

Tessellation tessellate(const Primitive& primitive, const Mat3d& linear, double sag_mm,
                        const std::optional<Vec3d>& towards) {
  const double scale = stretch(linear);
  if (!(scale > 0) || !std::isfinite(scale))
    return tessellation::fault("the placement is not finite or flattens everything");
  tessellation::Target target{linear, sag_mm / scale, std::nullopt};
  if (towards) target.towards = local_direction(linear, *towards);
  Tessellation t =
      std::visit([&](const auto& p) { return tessellation::make(p, target); }, primitive);
  t.mesh.sag_mm *= scale;
  for (Vec3d& v : t.mesh.vertices) v = linear * v;
  for (Vec3d& v : t.lines.points) v = linear * v;
  if (!fits(t)) return tessellation::fault("larger than 4 km");
  if (linear.determinant() < 0)
    for (Triangle& triangle : t.mesh.triangles) std::swap(triangle[1], triangle[2]);
  return t;
}

}  // namespace strake::geometry
