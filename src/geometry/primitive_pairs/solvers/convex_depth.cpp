// SPDX-License-Identifier: Apache-2.0
#include "geometry/primitive_pairs/solvers/convex_depth.hpp"

#include <algorithm>
#include <vector>

#include "geometry/primitive_pairs/shapes/support_mapping.hpp"

namespace strake::geometry::primitive_pairs {

DepthProbe ConvexDepthOracle::probe(const Vec3d& x, double /*r*/) const {
  const InteriorDistance::NearestFace near = field_.nearest(x);
  if (!(near.certain > 0)) {
    // Outside, the nearest face may not be the relevant one: the separating plane is.
    const GjkResult gap = gjk_distance(point_body(x), body_);
    if (gap.lower > 0) return {0, half_space(body_, gap.normal, 1)};
  }
  return {near.certain, half_space(body_, near.normal, 1)};
}

namespace {

/// Along the edges or axes of a body, which the parts of its frame are.
void add_directions(const ConvexBody& body, std::vector<Vec3d>& ways) {
  if (const auto* s = std::get_if<Prismoid>(&body.shape)) {
    ways.push_back(s->top.centre - s->bottom.centre);
    const bool top = dot(s->top.u, s->top.u) > dot(s->bottom.u, s->bottom.u);
    ways.push_back(top ? s->top.u : s->bottom.u);
    ways.push_back(top ? s->top.v : s->bottom.v);
  } else if (const auto* c = std::get_if<EllipsoidCap>(&body.shape)) {
    for (const Vec3d& way : {c->x, c->y, c->z}) ways.push_back(way);
  }
}

/// Grid units: the rounding of a depth, with a wide margin.
constexpr double kSame = 1.0 / 1024;

/// The points that are as deep as asked.
class DeepPoints {
 public:
  DeepPoints(const ConvexInterior& deep, const ConvexInterior& domain, double depth)
      : deep_(deep), domain_(domain), depth_(depth) {}

  [[nodiscard]] bool hold(const Vec3d& p) const {
    return domain_.field.nearest(p).depth >= -kSame &&
           deep_.field.nearest(p).depth >= depth_ - kSame;
  }

  /// How far one may go from one of them along a unit direction, to a part in 2^kHalvings.
  [[nodiscard]] double reach(const Vec3d& from, const Vec3d& way) const {
    constexpr int kHalvings = 13;
    double in = 0, out = 2 * std::min(deep_.body.radius, domain_.body.radius);
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = (in + out) / 2;
      (hold(from + way * middle) ? in : out) = middle;
    }
    return in;
  }

 private:
  const ConvexInterior &deep_, &domain_;
  double depth_ = 0;
};

}  // namespace

Vec3d centre_of_deep_points(const ConvexInterior& deep, const ConvexInterior& domain,
                            const Vec3d& from, double depth) {
  constexpr double kSquare = 1e-3;
  const DeepPoints points(deep, domain, depth);
  std::vector<Vec3d> ways;
  add_directions(deep.body, ways);
  add_directions(domain.body, ways);
  const Vec3d across = deep.field.nearest(from).normal;
  Vec3d at = from;
  for (const Vec3d& way : ways) {
    const Vec3d beside = way - across * dot(way, across);
    const double size = norm(beside);
    if (!(size > kSquare * norm(way))) continue;
    const Vec3d unit = beside * (1 / size);
    at = at + unit * ((points.reach(at, unit) - points.reach(at, -unit)) / 2);
  }
  return points.hold(at) ? at : from;
}

}  // namespace strake::geometry::primitive_pairs
