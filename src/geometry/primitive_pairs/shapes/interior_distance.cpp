// SPDX-License-Identifier: Apache-2.0
#include "geometry/primitive_pairs/shapes/interior_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <variant>

namespace strake::geometry::primitive_pairs {
namespace {

constexpr double kMinSine = 1e-6;
/// Roundings of a quadric's forms, its axes and its value, with a wide margin.
constexpr double kQuadricRounding = 512 * std::numeric_limits<double>::epsilon();

/// Rows of the inverse of a frame: forms of y = point - centre that give local millimetres.
struct InverseFrame {
  Vec3d x, y, z;
  double condition = 1;

  explicit InverseFrame(const GridFrame& f) {
    const double volume = dot(f.x, cross(f.y, f.z));
    x = cross(f.y, f.z) * (1 / volume);
    y = cross(f.z, f.x) * (1 / volume);
    z = cross(f.x, f.y) * (1 / volume);
    condition = std::max({norm(f.x), norm(f.y), norm(f.z)}) * std::max({norm(x), norm(y), norm(z)});
  }
};

double noise_of(const InverseFrame& i) { return kQuadricRounding * i.condition * i.condition; }

std::optional<Quadric> cone(const GridFrame& f, const SnoutPrimitive& p) {
  const InverseFrame i(f);
  const double h = 1 / p.height;
  QuadricForms forms;
  forms.p = i.x - i.z * (p.offset_x * h);
  forms.q = i.y - i.z * (p.offset_y * h);
  forms.r = i.z * ((p.top_radius - p.bottom_radius) * h);
  forms.s = (p.top_radius + p.bottom_radius) / 2;
  forms.sign = -1;
  forms.noise = noise_of(i) * (1 + (p.offset_x * p.offset_x + p.offset_y * p.offset_y) * h * h);
  return make_quadric(f.centre, forms);
}

std::optional<Quadric> ellipsoid(const GridFrame& f, const Vec3d& centre, double across,
                                 double along) {
  const InverseFrame i(f);
  QuadricForms forms;
  forms.p = i.x * (1 / across);
  forms.q = i.y * (1 / across);
  forms.r = i.z * (1 / along);
  forms.c = -1;
  forms.noise = noise_of(i);
  return make_quadric(f.placed(centre), forms);
}

struct Curved {
  const GridFrame& f;

  std::optional<Quadric> operator()(const CylinderPrimitive& p) const {
    SnoutPrimitive s;
    s.bottom_radius = s.top_radius = p.radius;
    s.height = p.height;
    return cone(f, s);
  }
  std::optional<Quadric> operator()(const SnoutPrimitive& p) const { return cone(f, p); }
  std::optional<Quadric> operator()(const SpherePrimitive& p) const {
    return ellipsoid(f, {}, p.diameter / 2, p.diameter / 2);
  }
  std::optional<Quadric> operator()(const EllipticalDishPrimitive& p) const {
    return ellipsoid(f, {}, p.radius, p.height);
  }
  std::optional<Quadric> operator()(const SphericalDishPrimitive& p) const {
    const double r = (p.radius / p.height * p.radius + p.height) / 2;
    return ellipsoid(f, {0, 0, p.height - r}, r, r);
  }
  template <class Other>
  std::optional<Quadric> operator()(const Other&) const {
    return std::nullopt;
  }
};

const Vec3d& longer(const Vec3d& a, const Vec3d& b) { return dot(a, a) >= dot(b, b) ? a : b; }

bool is_line(const CrossSection& s) { return !(dot(s.u, s.u) > 0) || !(dot(s.v, s.v) > 0); }

}  // namespace

bool InteriorDistance::add_face(const ConvexBody& body, const Vec3d& u, const Vec3d& v,
                                const Vec3d& through) {
  const Vec3d across = cross(u, v);
  const double length = norm(across), largest = norm(u) * norm(v);
  if (!(length > kMinSine * largest)) return false;
  BoundaryPlane& face = faces_[planes_++];
  face.normal = across * (dot(across, through - body.middle) < 0 ? -1 / length : 1 / length);
  face.offset = dot(face.normal, support(body.shape, face.normal));
  face.error = 4 * body.error * (largest / length);
  return true;
}

bool InteriorDistance::add_faces(const ConvexBody& body, const Prismoid& s) {
  if (!is_line(s.bottom) && !add_face(body, s.bottom.u, s.bottom.v, s.bottom.centre)) return false;
  if (!is_line(s.top) && !add_face(body, s.top.u, s.top.v, s.top.centre)) return false;
  if (s.round) return !(is_line(s.bottom) || is_line(s.top)) || add_apex(body, s);
  const Vec3d up = s.top.centre - s.bottom.centre;
  const Vec3d &u = longer(s.bottom.u, s.top.u), &v = longer(s.bottom.v, s.top.v);
  for (const double side : {-1.0, 1.0}) {
    const Vec3d x = (s.top.u - s.bottom.u) * side + up, y = (s.top.v - s.bottom.v) * side + up;
    if (!add_face(body, v, x, s.bottom.centre + s.bottom.u * side)) return false;
    if (!add_face(body, u, y, s.bottom.centre + s.bottom.v * side)) return false;
  }
  return true;
}

/// The cone's other half, beyond the apex, is none of the body's.
bool InteriorDistance::add_apex(const ConvexBody& body, const Prismoid& s) {
  const CrossSection &base = is_line(s.top) ? s.bottom : s.top,
                     &apex = is_line(s.top) ? s.top : s.bottom;
  return add_face(body, base.u, base.v, apex.centre);
}

bool InteriorDistance::add_faces(const ConvexBody& body, const EllipsoidCap& s) {
  return !(s.floor > -1) || add_face(body, s.x, s.y, s.centre + s.z * s.floor);
}

std::optional<InteriorDistance> InteriorDistance::of(const PlacedPrimitive& p,
                                                     const ConvexBody& body, const Vec3l& origin) {
  const auto frame = grid_frame(*p.placement, origin);
  if (!frame || body.flat) return std::nullopt;
  InteriorDistance field;
  const bool fine = std::visit(
      [&](const auto& shape) {
        using Shape = std::decay_t<decltype(shape)>;
        if constexpr (std::is_same_v<Shape, Prismoid> || std::is_same_v<Shape, EllipsoidCap>)
          return field.add_faces(body, shape);
        else
          return false;
      },
      body.shape);
  if (!fine) return std::nullopt;
  field.error_ = 4 * body.error;
  field.quadric_ = std::visit(Curved{*frame}, *p.primitive);
  if (field.quadric_) field.reach_ = 2 * body.radius + norm(field.quadric_->centre - body.middle);
  return field;
}

InteriorDistance::NearestFace InteriorDistance::nearest(const Vec3d& x) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  NearestFace nearest{kInfinity, kInfinity, {}};
  for (std::size_t i = 0; i < planes_; ++i) {
    const double depth = faces_[i].offset - dot(faces_[i].normal, x);
    nearest.certain = std::min(nearest.certain, depth - faces_[i].error);
    if (depth < nearest.depth) {
      nearest.depth = depth;
      nearest.normal = faces_[i].normal;
    }
  }
  if (quadric_) {
    const double reach = std::max(reach_, norm(x - quadric_->centre));
    const QuadricDepth foot = quadric_depth(*quadric_, x, reach);
    nearest.certain = std::min(nearest.certain, foot.certain - error_);
    if (foot.depth < nearest.depth) {
      nearest.depth = foot.depth;
      nearest.normal = foot.normal;
    }
  }
  nearest.certain = std::max(nearest.certain, 0.0);
  return nearest;
}

}  // namespace strake::geometry::primitive_pairs
