// SPDX-License-Identifier: Apache-2.0
// The basic exact tests: what a ray hits, where a bolt lies in a flange, how far a pipe's axis is
// from an edge, and which way two boxes part. Coordinates are micrometres.
#include <array>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "strake/geometry/closest.hpp"
#include "strake/geometry/inside.hpp"
#include "strake/geometry/intersect.hpp"
#include "strake/geometry/separating_axis.hpp"

using namespace strake::geometry;

namespace {

/// A ray that meets a triangle in its inside, through a corner, and along its plane.
bool rays() {
  const TriangleCorners wall{{{500, -300, -300}, {500, 600, -300}, {500, -300, 600}}};
  const Vec3l eye{0, 0, 0};
  const LineInTriangle through = intersect({eye, {1, 0, 0}, LineKind::ray}, wall);
  const bool inside = through.at.touch == Touch::point && through.feature_first == 7;
  const LineInTriangle corner = intersect({eye, {500, 600, -300}, LineKind::ray}, wall);
  const LineInTriangle along = intersect({{500, -900, 0}, {500, 900, 0}, LineKind::segment}, wall);
  const Vec3d where = point_at({eye, {1, 0, 0}, LineKind::ray}, through.at.first).value();
  std::printf("the ray meets the wall at x = %g\n", where.x);
  return inside && where == Vec3d{500, 0, 0} && corner.feature_first == 2 && along.coplanar &&
         along.at.touch == Touch::segment;
}

/// A square flange with a square hole, seen along z.
bool points_of_a_flange() {
  const std::vector<Vec3l> points{{0, 0, 0},   {90, 0, 0},  {90, 90, 0}, {0, 90, 0},
                                  {30, 30, 0}, {60, 30, 0}, {60, 60, 0}, {30, 60, 0}};
  const std::vector<std::uint32_t> first{0, 4, 8};
  const auto side = [&](std::int64_t x, std::int64_t y) {
    return side_of_polygon(points, first, 2, {{x, y, 0}, 1});
  };
  return side(10, 10) == PointSide::inside && side(45, 45) == PointSide::outside &&
         side(30, 45) == PointSide::on_boundary;
}

bool distances() {
  const Segment axis{{{0, 0, 0}, {0, 0, 1000}}};
  const Segment edge{{{300, 400, 500}, {600, 400, 100}}};
  const ClosestPoints c = closest_points(axis, edge);
  std::printf("axis to edge: %g\n", c.squared.distance());
  return c.squared.distance() == 500 && c.feature_a == 3 && c.feature_b == 1;
}

bool axes() {
  const Box3l box{{0, 0, 0}, {100, 100, 100}};
  const SeparatingAxis apart = separating_axis(box, {{130, 20, 20}, {200, 80, 80}});
  const SeparatingAxis flush = separating_axis(box, {{100, 0, 0}, {200, 100, 100}});
  const SeparatingAxis deep = separating_axis(box, {{90, 10, 10}, {200, 80, 80}});
  return apart.separation == Separation::apart && apart.width() == 30 &&
         flush.separation == Separation::touching && deep.separation == Separation::overlapping &&
         deep.width() == -10 && deep.axis == Vec3<Int128>{1, 0, 0};
}

}  // namespace

int main() {
  const std::array<bool, 4> right{rays(), points_of_a_flange(), distances(), axes()};
  for (std::size_t i = 0; i < right.size(); ++i)
    if (!right[i]) {
      std::printf("check %zu failed\n", i);
      return 1;
    }
  return 0;
}
