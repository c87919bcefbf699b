// SPDX-License-Identifier: Apache-2.0
#include "geometry/primitive_pairs/shapes/convex_body.hpp"

#include <algorithm>
#include <initializer_list>

#include "strake/geometry/grid.hpp"

namespace strake::geometry::primitive_pairs {
namespace {

/// A map whose image of a cube has less than this part of the volume that its edges could span
/// counts as flat.
constexpr double kFlat = 1e-6;

bool are_lengths(std::initializer_list<double> lengths) {
  return std::all_of(lengths.begin(), lengths.end(),
                     [](double l) { return l >= 0 && std::isfinite(l); });
}

double size_of(const CrossSection& s) {
  return primitive_pairs::size_of(s.centre) + primitive_pairs::size_of(s.u) +
         primitive_pairs::size_of(s.v);
}

/// A section in the local frame, millimetres.
CrossSection placed(const GridFrame& f, const CrossSection& local) {
  return {f.placed(local.centre), f.turned(local.u), f.turned(local.v)};
}

ConvexBody prismoid(const GridFrame& f, const CrossSection& bottom, const CrossSection& top,
                    bool round) {
  ConvexBody body;
  const Prismoid shape{placed(f, bottom), placed(f, top), round};
  body.middle = (shape.bottom.centre + shape.top.centre) * 0.5;
  for (const CrossSection& section : {shape.bottom, shape.top})
    body.radius = std::max(body.radius,
                           norm(section.centre - body.middle) + norm(section.u) + norm(section.v));
  body.reach = std::max(size_of(shape.bottom), size_of(shape.top)) + f.reach;
  body.error = kSupportRounding * body.reach;
  body.shape = shape;
  return body;
}

ConvexBody cap(const GridFrame& f, const Vec3d& centre, const Vec3d& half, double floor,
               double rim) {
  ConvexBody body;
  const EllipsoidCap shape{f.placed(centre), f.x * half.x, f.y * half.y, f.z * half.z, floor, rim};
  body.middle = shape.centre + shape.z * ((1 + floor) / 2);
  body.radius = norm(shape.x) + norm(shape.y) + norm(shape.z);
  body.reach = f.reach + primitive_pairs::size_of(shape.centre) +
               primitive_pairs::size_of(shape.x) + primitive_pairs::size_of(shape.y) +
               primitive_pairs::size_of(shape.z);
  body.error = kSupportRounding * body.reach;
  body.shape = shape;
  return body;
}

/// z = x·dx + y·dy above the centre of an end circle.
struct SlantedEndPlane {
  double x = 0, y = 0;

  [[nodiscard]] double steepness() const { return std::sqrt(x * x + y * y); }
};

SlantedEndPlane slope_of(double shear_x, double shear_y) {
  const SinCos x = sin_cos(shear_x), y = sin_cos(shear_y);
  return {x.sin / x.cos, y.sin / y.cos};
}

/// An end of a snout: where a plane through the centre of one of the cone's circles cuts it. Seen
/// along the generators this is a conic with a focus on the axis, r = radius + e·x.
struct SnoutEnd {
  double radius = 0, at = 0;  ///< of the circle, `at` = -1/2 or 1/2 of the height
  SlantedEndPlane slope;

  /// `loss` grows by what cancellation costs.
  [[nodiscard]] std::optional<CrossSection> cut(const SnoutPrimitive& p, double& loss) const {
    const Vec3d rise{p.offset_x, p.offset_y, p.height};
    const Vec3d centre = rise * at;
    const double steep = slope.steepness();
    if (radius == 0 || steep == 0) return CrossSection{centre, {radius, 0, 0}, {0, radius, 0}};
    const double lift = p.height - slope.x * p.offset_x - slope.y * p.offset_y;
    const double e = (p.top_radius - p.bottom_radius) * steep / lift;
    const double rest = 1 - e * e;
    if (!(lift > 0) || !(steep < 100) || !(rest > 1e-3)) return std::nullopt;
    const Vec3d way = Vec3d{slope.x / steep, slope.y / steep, 0} + rise * (steep / lift);
    loss += (1 + steep * steep) / rest * (1 + (norm(rise) * steep) / lift);
    return CrossSection{centre + way * (radius * e / rest), way * (radius / rest),
                        Vec3d{-slope.y / steep, slope.x / steep, 0} * (radius / std::sqrt(rest))};
  }

  /// How far a section reaches above this end's plane, measured along z.
  [[nodiscard]] double above(const SnoutPrimitive& p, const CrossSection& s, double side) const {
    const Vec3d n = Vec3d{-slope.x, -slope.y, 1} * side;
    const Vec3d from = s.centre - Vec3d{p.offset_x, p.offset_y, p.height} * at;
    const double u = dot(n, s.u), v = dot(n, s.v);
    return dot(n, from) + std::sqrt(u * u + v * v);
  }
};

std::optional<ConvexBody> snout(const SnoutPrimitive& p, const GridFrame& f) {
  if (!are_lengths({p.bottom_radius, p.top_radius, p.height}) || !(p.height > 0) ||
      !(p.bottom_radius + p.top_radius > 0))
    return std::nullopt;
  const SnoutEnd bottom{p.bottom_radius, -0.5, slope_of(p.bottom_shear_x, p.bottom_shear_y)};
  const SnoutEnd top{p.top_radius, 0.5, slope_of(p.top_shear_x, p.top_shear_y)};
  double loss = 1;
  const auto low = bottom.cut(p, loss), high = top.cut(p, loss);
  if (!low || !high) return std::nullopt;
  // Planes that meet inside the cone leave a wedge, which its ends do not span.
  if (p.top_radius > 0 && !(top.above(p, *low, 1) < 0)) return std::nullopt;
  if (p.bottom_radius > 0 && !(bottom.above(p, *high, -1) < 0)) return std::nullopt;
  ConvexBody body = prismoid(f, *low, *high, true);
  body.error *= loss;
  return body;
}

struct ConvexBodyBuilder {
  const GridFrame& f;

  std::optional<ConvexBody> operator()(const BoxPrimitive& p) const {
    if (!are_lengths({p.length_x, p.length_y, p.length_z})) return std::nullopt;
    const Vec3d u{p.length_x / 2, 0, 0}, v{0, p.length_y / 2, 0};
    ConvexBody body =
        prismoid(f, {{0, 0, -p.length_z / 2}, u, v}, {{0, 0, p.length_z / 2}, u, v}, false);
    body.flat = !(p.length_x > 0) || !(p.length_y > 0) || !(p.length_z > 0);
    return body;
  }
  std::optional<ConvexBody> operator()(const PyramidPrimitive& p) const {
    if (!are_lengths({p.bottom_x, p.bottom_y, p.top_x, p.top_y, p.height})) return std::nullopt;
    const Vec3d half{p.offset_x / 2, p.offset_y / 2, p.height / 2};
    ConvexBody body = prismoid(f, {-half, {p.bottom_x / 2, 0, 0}, {0, p.bottom_y / 2, 0}},
                               {half, {p.top_x / 2, 0, 0}, {0, p.top_y / 2, 0}}, false);
    body.flat = !(p.height > 0) || !(p.bottom_x + p.top_x > 0) || !(p.bottom_y + p.top_y > 0);
    return body;
  }
  std::optional<ConvexBody> operator()(const CylinderPrimitive& p) const {
    if (!are_lengths({p.radius, p.height}) || !(p.radius > 0)) return std::nullopt;
    const Vec3d u{p.radius, 0, 0}, v{0, p.radius, 0};
    ConvexBody body =
        prismoid(f, {{0, 0, -p.height / 2}, u, v}, {{0, 0, p.height / 2}, u, v}, true);
    body.flat = !(p.height > 0);
    return body;
  }
  std::optional<ConvexBody> operator()(const SnoutPrimitive& p) const { return snout(p, f); }
  std::optional<ConvexBody> operator()(const SpherePrimitive& p) const {
    if (!are_lengths({p.diameter}) || !(p.diameter > 0)) return std::nullopt;
    const double r = p.diameter / 2;
    return cap(f, {}, {r, r, r}, -1, 0);
  }
  std::optional<ConvexBody> operator()(const EllipticalDishPrimitive& p) const {
    if (!are_lengths({p.radius, p.height}) || !(p.radius > 0)) return std::nullopt;
    ConvexBody body = cap(f, {}, {p.radius, p.radius, p.height}, 0, 1);
    body.flat = !(p.height > 0);
    return body;
  }
  std::optional<ConvexBody> operator()(const SphericalDishPrimitive& p) const {
    if (!are_lengths({p.radius, p.height}) || !(p.radius > 0)) return std::nullopt;
    if (!(p.height > 0)) return (*this)(EllipticalDishPrimitive{p.radius, 0});
    const double r = (p.radius / p.height * p.radius + p.height) / 2;
    if (!(r < 1e6 * p.radius)) return std::nullopt;
    return cap(f, {0, 0, p.height - r}, {r, r, r}, 1 - p.height / r, p.radius / r);
  }
  std::optional<ConvexBody> operator()(const CircularTorusPrimitive&) const { return std::nullopt; }
  std::optional<ConvexBody> operator()(const RectangularTorusPrimitive&) const {
    return std::nullopt;
  }
  std::optional<ConvexBody> operator()(const LinePrimitive&) const { return std::nullopt; }
};

}  // namespace

std::optional<GridFrame> grid_frame(const Placement& placement, const Vec3l& origin) {
  const auto centre = snap(placement.translation);
  if (!centre) return std::nullopt;
  const Mat3d& m = placement.linear;
  const auto column = [&](int k) {
    return Vec3d{m.row[0][k], m.row[1][k], m.row[2][k]} * kGridPerMm;
  };
  GridFrame f{column(0), column(1), column(2), (*centre - origin).as<double>(), 0};
  f.reach = size_of(f.centre);
  const double volume = std::fabs(dot(f.x, cross(f.y, f.z)));
  if (!(volume > kFlat * norm(f.x) * norm(f.y) * norm(f.z)) || !std::isfinite(volume))
    return std::nullopt;
  return f;
}

std::optional<ConvexBody> convex_body(const PlacedPrimitive& p, const Vec3l& origin) {
  const auto frame = grid_frame(*p.placement, origin);
  if (!frame) return std::nullopt;
  auto body = std::visit(ConvexBodyBuilder{*frame}, *p.primitive);
  if (body && !std::isfinite(body->reach)) return std::nullopt;
  return body;
}

ConvexBody triangle_body(const std::array<Vec3d, 3>& corners) {
  ConvexBody body;
  body.middle = (corners[0] + corners[1] + corners[2]) * (1.0 / 3);
  for (const Vec3d& c : corners) {
    body.reach = std::max(body.reach, size_of(c));
    body.radius = std::max(body.radius, norm(c - body.middle));
  }
  body.error = kSupportRounding * body.reach;
  body.shape = TriangleShape{corners};
  body.flat = true;
  return body;
}

ConvexBody block_body(const Vec3d& centre, const Vec3d& half) {
  ConvexBody body;
  body.middle = centre;
  body.radius = norm(half);
  body.reach = size_of(centre) + size_of(half);
  body.error = kSupportRounding * body.reach;
  body.shape = BoxShape{centre, half};
  return body;
}

}  // namespace strake::geometry::primitive_pairs
