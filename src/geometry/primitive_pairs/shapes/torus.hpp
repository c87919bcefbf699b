// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "geometry/numeric/trig.hpp"
#include "geometry/primitive_pairs/shapes/convex_body.hpp"
#include "strake/geometry/lower_dimensional_body.hpp"

namespace strake::geometry::primitive_pairs {

/// A part of a sweep, at most a quarter circle.
struct SweptArc {
  double from = 0, to = 0;  ///< angles from the start of the sweep
  SinCos first, last;

  [[nodiscard]] static SweptArc between(double from, double to) {
    return {from, to, sin_cos(from), sin_cos(to)};
  }
  [[nodiscard]] double middle() const { return (from + to) / 2; }
};

/// A circular or rectangular torus, grid units about the pair's origin. It is not convex: it is
/// split into arcs, whose convex hulls have supports, and its distances to points are closed forms.
class Torus {
 public:
  /// Returns a placed torus. Nothing for other kinds, for tubes that reach
  /// beyond the axis, for lengths that make no body, and for placements that are no similarity to
  /// within kMaxOrthonormalError.
  [[nodiscard]] static std::optional<Torus> of(const PlacedPrimitive& p, const Vec3l& origin);
  /// Returns an arc as a torus whose tube has no radius.
  [[nodiscard]] static std::optional<Torus> of(const CircularArc& arc, const Vec3l& origin);

  [[nodiscard]] std::vector<SweptArc> arcs() const;
  /// Returns the convex hull of the profile swept through an arc, or of the tube's centre line
  /// there.
  [[nodiscard]] ConvexBody hull(const SweptArc& arc) const;
  [[nodiscard]] ConvexBody spine(const SweptArc& arc) const;
  /// Returns the axis, as far as the torus reaches.
  [[nodiscard]] ConvexBody axis() const;
  /// Whether a sweep of more than half a circle leaves a notch, which then is convex.
  [[nodiscard]] bool notched() const { return !full_ && angle_ > kPi; }
  /// Returns the notch as far as the torus reaches, moved by `shift` away from the axis.
  [[nodiscard]] ConvexBody notch(double shift) const;

  /// Returns a point of the body: the nearest one up to rounding, unless p is far beyond both ends
  /// of the sweep.
  [[nodiscard]] Vec3d nearest(const Vec3d& p) const;
  /// Returns the depth of a point, minus the distance outside; off by at most error().
  [[nodiscard]] double depth(const Vec3d& p) const;
  /// Returns the unit direction from a point in the body to the nearest surface point.
  [[nodiscard]] Vec3d exit_direction(const Vec3d& p) const;

  /// Returns a point in coordinates about the centre along the orthonormal axes.
  [[nodiscard]] Vec3d local(const Vec3d& p) const;
  [[nodiscard]] Vec3d turned(const Vec3d& local) const {
    return axes_[0] * local.x + axes_[1] * local.y + axes_[2] * local.z;
  }

  [[nodiscard]] bool flat() const { return flat_; }
  [[nodiscard]] bool full() const { return full_; }
  [[nodiscard]] double angle() const { return angle_; }
  [[nodiscard]] const Profile& profile() const { return profile_; }
  [[nodiscard]] const Vec3d& centre() const { return centre_; }
  [[nodiscard]] double radius() const { return radius_; }
  /// Returns a bound on the displacement of a point by the rounding of axes and arithmetic.
  [[nodiscard]] double error() const { return error_; }

 private:
  struct Shape;
  struct Meridian;
  struct End;
  [[nodiscard]] static std::optional<Torus> place(const Shape& shape, const Placement& placement,
                                                  const Vec3l& origin);
  [[nodiscard]] Meridian meridian(const Vec3d& local) const;
  [[nodiscard]] double profile_depth(double out, double up) const;
  [[nodiscard]] End nearest_end(const Vec3d& local) const;

  std::array<Vec3d, 3> axes_{};
  GridFrame frame_;
  Vec3d centre_;
  Profile profile_;        ///< grid units
  Profile local_profile_;  ///< millimetres
  double angle_ = 0;
  SinCos end_;
  bool full_ = false, flat_ = false;
  double radius_ = 0, reach_ = 0, error_ = 0;
};

}  // namespace strake::geometry::primitive_pairs
