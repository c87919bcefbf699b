// SPDX-License-Identifier: Apache-2.0
#include "geometry/analytic/inside.hpp"

#include <algorithm>
#include <limits>

namespace strake::geometry::analytic {
namespace {

constexpr int kMaxDescents = 24;
/// Grid units: a body that sticks out by more is not looked at more closely.
constexpr double kFarOut = 1e4;

double room(const ConvexBody& inner, const ConvexBody& outer, const Vec3d& n) {
  return dot(n, support(outer.shape, n) - support(inner.shape, n));
}

/// Alternates between the inner body's farthest point and the face nearest to it, each of which
/// can only lessen the room.
double descend(const ConvexBody& inner, const ConvexBody& outer, const InnerField& field, Vec3d n) {
  double least = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kMaxDescents; ++step) {
    n = field.nearest(support(inner.shape, n)).normal;
    const double next = room(inner, outer, n);
    if (!(next < least)) break;
    least = next;
  }
  return least;
}

/// Its ends in the sweep, a body may have its middle in what the sweep leaves out. `shift` keeps
/// the common point that is found off the axis, where the two may only touch.
double beside_notch(const PairSide& inner, const ConvexBody& hull, const Torus& ring) {
  constexpr double kFirstShift = 4, kGrowth = 4;
  double least = std::numeric_limits<double>::infinity();
  for (double shift = kFirstShift; shift < ring.radius(); shift *= kGrowth) {
    const ConvexGap gap = convex_gap(ring.notch(shift), hull);
    least = std::min(least, ring.depth(inner.real(gap.on_b)));
    if (gap.lower > 0) break;
  }
  return least;
}

/// A torus is not convex: a body may have its ends in it and its middle in the hole. So beside its
/// extremes its place nearest to the axis is looked at, and those half way through it.
double inside_ring(const PairSide& inner, const ConvexBody& hull, const Torus& ring) {
  const auto depth = [&](const Vec3d& p) { return ring.depth(inner.real(p)); };
  double least = depth(convex_gap(ring.axis(), hull).on_b);
  if (ring.notched()) least = std::min(least, beside_notch(inner, hull, ring));
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z) {
        Vec3d n = ring.turned({x * 1.0, y * 1.0, z * 1.0});
        const Vec3d middle = (support(hull.shape, n) + support(hull.shape, -n)) * 0.5;
        least = std::min(least, depth(middle));
        for (int step = 0; step < kMaxDescents; ++step) {
          const Vec3d at = inner.real(support(hull.shape, n));
          const double next = ring.depth(at);
          if (step > 0 && !(next < least)) break;
          least = std::min(least, next);
          n = ring.way_out(at);
        }
      }
  return least;
}

}  // namespace

double inside_by(const ConvexBody& inner, const ConvexBody& outer, const InnerField& field) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < field.planes(); ++i)
    least = std::min(least, room(inner, outer, field.normal(i)));
  if (!field.curved()) return least;
  const auto& axes = field.quadric().axes;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        if (least < -kFarOut) return least;
        const Vec3d n = axes[0] * x + axes[1] * y + axes[2] * z;
        if (x != 0 || y != 0 || z != 0) least = std::min(least, descend(inner, outer, field, n));
      }
  return least;
}

double inside_by(const PairSide& inner, const PairSide& outer) {
  double least = std::numeric_limits<double>::infinity();
  for (const Arc& arc : inner.arcs()) {
    const ConvexBody hull = inner.hull(arc);
    if (outer.field) {
      least = std::min(least, inside_by(hull, *outer.convex, *outer.field));
      continue;
    }
    if (!outer.torus) return -std::numeric_limits<double>::infinity();
    least = std::min(least, inside_ring(inner, hull, *outer.torus));
  }
  return least;
}

}  // namespace strake::geometry::analytic
