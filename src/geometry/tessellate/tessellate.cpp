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

}  // namespace

Tessellation tessellate(const Primitive& primitive, const Mat3d& linear, double sag_mm,
                        const std::optional<Vec3d>& towards) {
  const double scale = stretch(linear);
  if (!(scale > 0) || !std::isfinite(scale))
    return tessellation::fault("the placement is not finite or flattens everything");
  tessellation::Target target{linear, sag_mm / scale, std::nullopt};
  if (towards) target.towards = tessellation::local_direction(linear, *towards);
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
