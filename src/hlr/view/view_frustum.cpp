// SPDX-License-Identifier: Apache-2.0
#include "hlr/view/view_frustum.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>

#include "geometry/numeric/trig.hpp"
#include "hlr/view/projection.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/geometry/wide_int.hpp"

namespace strake::hlr {
namespace {

using geometry::Int128;
using geometry::Vec3d;
using geometry::Vec3l;

constexpr double kFinestNormal = 1048576;  // 20 bits of a normal
constexpr std::int64_t kMaxEye = std::int64_t{1} << 50;
constexpr double kMinNearMm = geometry::kMmPerGrid, kMaxNearMm = 1e6;
constexpr double kNarrowest = 1, kWidest = 160;

bool within_reach(const Vec3l& p) {
  for (int k = 0; k < 3; ++k)
    if (p[k] > kMaxEye || p[k] < -kMaxEye) return false;  // abs() of the least does not exist
  return true;
}

HalfSpace near_plane(const View& view) {
  const Vec3l d = in_lowest_terms(view.direction);
  const Vec3d size = d.as<double>();
  const double least =
      view.perspective->near_mm * geometry::kGridPerMm * std::sqrt(dot(size, size));
  return {-d, static_cast<std::int64_t>(std::ceil(least))};
}

/// A side of the frustum: through the eye, so wide that `across`, a unit vector on paper, reaches
/// the rim.
HalfSpace side(const Vec3d& toward, const Vec3d& across, double tangent) {
  const Vec3d inward = toward * -tangent - across;
  const double largest = std::max({std::fabs(inward.x), std::fabs(inward.y), std::fabs(inward.z)});
  Vec3l normal;
  for (int k = 0; k < 3; ++k) normal[k] = std::llround(inward[k] / largest * kFinestNormal);
  return {normal, 0};
}

}  // namespace

Error view_error(std::string message, std::string mend) {
  return {ErrorCode::usage, std::move(message), "view", std::move(mend)};
}

std::vector<HalfSpace> window(const View& view) {
  if (!view.perspective) return {};
  const geometry::SinCos half =
      geometry::sin_cos(view.perspective->field_of_view_deg / 360 * geometry::kPi);
  const double tangent = half.sin / half.cos;
  const ViewAxes axes = axes_of(view);
  return {near_plane(view), side(axes.toward, axes.right, tangent),
          side(axes.toward, -axes.right, tangent), side(axes.toward, axes.up, tangent),
          side(axes.toward, -axes.up, tangent)};
}

Status check_perspective(const View& view) {
  if (!view.perspective) return {};
  const Perspective& p = *view.perspective;
  if (!within_reach(p.eye) || !within_reach(p.target))
    return view_error("the eye or the target lies beyond a million kilometres",
                      "give points near the model");
  if (p.eye == p.target)
    return view_error("the eye and the target are the same point", "give a target to look at");
  if (!(p.near_mm >= kMinNearMm && p.near_mm <= kMaxNearMm))
    return view_error("the near distance is not between a micrometre and a kilometre",
                      "write 1um to 1km; 100mm is the usual one");
  if (!(p.field_of_view_deg >= kNarrowest && p.field_of_view_deg <= kWidest))
    return view_error("the field of view is not between 1 and 160 degrees",
                      "write 1deg to 160deg; 90deg is the usual one");
  const HalfSpace before = near_plane(view);
  Int128 depth = 0;
  for (int k = 0; k < 3; ++k)
    depth += static_cast<Int128>(before.normal[k]) * (p.target[k] - p.eye[k]);
  if (depth <= 0)
    return view_error("the target lies behind the eye",
                      "let the direction point from target to eye");
  if (depth < before.least)
    return view_error("the target lies nearer to the eye than what is drawn",
                      "move the eye away, or give a smaller near distance");
  return {};
}

}  // namespace strake::hlr
