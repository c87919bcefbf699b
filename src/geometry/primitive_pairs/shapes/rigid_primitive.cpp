// SPDX-License-Identifier: Apache-2.0
#include "geometry/primitive_pairs/shapes/rigid_primitive.hpp"

#include <variant>

#include "strake/geometry/grid.hpp"

namespace strake::geometry::primitive_pairs {
namespace {

using ThreeLengths = std::array<double, 3>;

/// A linear map as orthonormal axes and one scale along each.
struct ScaledAxes {
  std::array<Vec3d, 3> axes;
  ThreeLengths scale{};
};

Vec3d column(const Mat3d& m, int k) { return {m.row[0][k], m.row[1][k], m.row[2][k]}; }

/// Takes Z first, the axis of cylinders; then y, made perpendicular to it.
std::optional<ScaledAxes> frame_of(const Mat3d& m) {
  const Vec3d x = column(m, 0), y = column(m, 1), z = column(m, 2);
  ScaledAxes f;
  f.scale = {norm(x), norm(y), norm(z)};
  if (!(f.scale[0] > 0) || !(f.scale[1] > 0) || !(f.scale[2] > 0)) return std::nullopt;
  f.axes[2] = z * (1 / f.scale[2]);
  const Vec3d square = y - f.axes[2] * dot(f.axes[2], y);
  if (!(norm(square) > 0.5 * f.scale[1])) return std::nullopt;
  f.axes[1] = square * (1 / norm(square));
  const Vec3d third = cross(f.axes[1], f.axes[2]);
  f.axes[0] = dot(third, x) < 0 ? -third : third;
  return f;
}

/// How far the map takes points of a body within `reach` of its centre, along each local axis,
/// from where axes and scales take them.
double moved(const Mat3d& m, const ScaledAxes& f, const ThreeLengths& scale,
             const ThreeLengths& reach) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    sum += norm(column(m, static_cast<int>(k)) - f.axes[k] * scale[k]) * reach[k];
  return sum;
}

/// The kind and its local half lengths, millimetres.
bool read(const Primitive& primitive, RigidPrimitive::Kind& kind, ThreeLengths& half) {
  if (const auto* sphere = std::get_if<SpherePrimitive>(&primitive)) {
    kind = RigidPrimitive::Kind::sphere;
    half.fill(sphere->diameter / 2);
  } else if (const auto* cylinder = std::get_if<CylinderPrimitive>(&primitive)) {
    kind = RigidPrimitive::Kind::cylinder;
    half = {cylinder->radius, cylinder->radius, cylinder->height / 2};
  } else if (const auto* box = std::get_if<BoxPrimitive>(&primitive)) {
    kind = RigidPrimitive::Kind::box;
    half = {box->length_x / 2, box->length_y / 2, box->length_z / 2};
  } else {
    return false;
  }
  return half[0] > 0 && half[1] > 0 && half[2] > 0;
}

}  // namespace

std::optional<OrthonormalFrame> orthonormalised(const Mat3d& linear, double reach) {
  const auto frame = frame_of(linear);
  if (!frame) return std::nullopt;
  OrthonormalFrame s{frame->axes, frame->scale[2], 0};
  s.moved = moved(linear, *frame, {s.scale, s.scale, s.scale}, {reach, reach, reach});
  if (!(s.moved * kGridPerMm < kMaxOrthonormalError)) return std::nullopt;
  return s;
}

std::optional<RigidPrimitive> rigid_primitive(const PlacedPrimitive& p) {
  RigidPrimitive solid;
  ThreeLengths local{};
  if (!read(*p.primitive, solid.kind, local)) return std::nullopt;
  const auto frame = frame_of(p.placement->linear);
  const auto centre = snap(p.placement->translation);
  if (!frame || !centre) return std::nullopt;
  ThreeLengths scale = frame->scale;
  if (solid.kind == RigidPrimitive::Kind::sphere) scale.fill(scale[2]);
  if (solid.kind == RigidPrimitive::Kind::cylinder) scale[0] = scale[1];
  solid.axes = frame->axes;
  solid.centre = *centre;
  for (std::size_t k = 0; k < 3; ++k) solid.half[k] = local[k] * scale[k] * kGridPerMm;
  solid.error = moved(p.placement->linear, *frame, scale, local) * kGridPerMm;
  if (!(solid.error < kMaxOrthonormalError)) return std::nullopt;
  return solid;
}

}  // namespace strake::geometry::primitive_pairs
