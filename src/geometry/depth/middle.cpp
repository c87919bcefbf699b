// SPDX-License-Identifier: Apache-2.0
#include "geometry/depth/middle.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "geometry/directions.hpp"
#include "strake/geometry/depth.hpp"

namespace strake::geometry {
namespace {

/// A direction with no more than this of another counts as square to it: more than what the snap
/// turns a face by, so that two faces on each other hold a point across them only.
constexpr double kSquare = 1e-3;
/// A boundary that a way runs along but for this is not met by it.
constexpr double kAlong = 1e-9;
/// A boundary whose multiplier is less hardly holds the ball: it gives way to a move of the ball
/// that costs a thousandth of the move.
constexpr double kHolds = 1e-3;

/// Orthonormal directions that a point may still be moved along.
class FreeDirections {
 public:
  [[nodiscard]] std::size_t count() const { return axes_.size(); }
  [[nodiscard]] const Vec3d& first() const { return axes_.front(); }

  [[nodiscard]] Vec3d part_of(const Vec3d& v) const {
    Vec3d sum;
    for (const Vec3d& axis : axes_) sum = sum + axis * dot(axis, v);
    return sum;
  }

  /// No longer along `v`.
  void hold(const Vec3d& v) {
    const Vec3d along = part_of(v);
    if (!(length(along) > kSquare)) return;
    std::vector<Vec3d> left{unit(along)};
    for (const Vec3d& axis : axes_) {
      Vec3d rest = axis;
      for (const Vec3d& other : left) rest = rest - other * dot(other, rest);
      // Of two or three unit vectors that span the same, one has at least so much beside the rest.
      constexpr double kLeast = 0.5;
      if (left.size() < axes_.size() && length(rest) > kLeast) left.push_back(unit(rest));
    }
    left.erase(left.begin());
    axes_ = std::move(left);
  }

 private:
  std::vector<Vec3d> axes_{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
};

/// The region as it is cut by the directions that are free, about a point of it.
std::vector<RadiusConstraint> section(std::span<const RadiusConstraint> region, const Vec3d& from,
                                      const FreeDirections& free, double extent) {
  std::vector<RadiusConstraint> rows;
  rows.reserve(4 + region.size());
  // They start the search, too far off to matter.
  constexpr double kFar = 8;
  for (const Vec3d& n : tetrahedral_directions()) rows.push_back({n, 1, kFar * extent});
  for (const RadiusConstraint& c : region) {
    const Vec3d beside = free.part_of(c.normal);
    const double share = length(beside);
    if (!(share > kAlong)) continue;
    const double room = std::max(c.offset - dot(c.normal, from), 0.0);
    rows.push_back({beside * (1 / share), 1, room / share});
  }
  return rows;
}

/// The middle of the chord through a point.
double middle_of_chord(std::span<const RadiusConstraint> region, const Vec3d& from,
                       const Vec3d& along, double extent) {
  double lo = -2 * extent, hi = 2 * extent;
  for (const RadiusConstraint& c : region) {
    const double share = dot(c.normal, along);
    if (!(std::fabs(share) > kAlong)) continue;
    const double room = std::max(c.offset - dot(c.normal, from), 0.0) / share;
    if (share > 0)
      hi = std::min(hi, room);
    else
      lo = std::max(lo, room);
  }
  return (lo + hi) / 2;
}

}  // namespace

Vec3d way_to_middle(std::span<const RadiusConstraint> region, double extent) {
  Vec3d way;
  FreeDirections free;
  while (free.count() > 1) {
    const std::vector<RadiusConstraint> rows = section(region, way, free, extent);
    const RadiusSolution ball = maximise_radius({rows, extent});
    way = way + free.part_of(ball.x);
    const std::size_t before = free.count();
    for (const RadiusSolution::Held& held : ball.held)
      if (held.multiplier > kHolds) free.hold(rows[held.by].normal);
    if (free.count() == before) return way;
  }
  if (free.count() == 1)
    way = way + free.first() * middle_of_chord(region, way, free.first(), extent);
  return way;
}

}  // namespace strake::geometry
