// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "hlr/view/projection.hpp"
#include "hlr/view/view_bvh.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::hlr {

/// A point as a picture shows it, off by `error_bound` at most in each coordinate.
struct PerspectivePoint {
  double u = 0, v = 0, w = 0;
  double depth = 0;  ///< before the eye, grid units
  double error_bound = 0;
};

/// The drawn part of an edge in a picture, by the parameters of the edge: a straight line there
/// too, along which parameters run projectively.
class PerspectiveSegment {
 public:
  PerspectiveSegment() = default;
  PerspectiveSegment(const PerspectivePoint& a, const PerspectivePoint& b, double from, double to);

  [[nodiscard]] const PerspectivePoint& a() const { return a_; }
  [[nodiscard]] const PerspectivePoint& b() const { return b_; }
  /// How far any point of it is off, at a parameter that is known to the last place.
  [[nodiscard]] double error_bound() const { return error_bound_; }
  /// Of the line from a to b the share that a parameter of the edge has gone, and back.
  [[nodiscard]] double fraction(double t) const;
  [[nodiscard]] double parameter(double fraction) const;
  /// Whether one end is so much nearer than the other that parameters lose their digits.
  [[nodiscard]] bool is_steep() const;

  /// For a query about the part between two parameters.
  [[nodiscard]] SegmentQuery make_query(double from, double to) const;
  [[nodiscard]] ViewBox box() const;

 private:
  PerspectivePoint a_, b_;
  double from_ = 0, to_ = 1, error_bound_ = 0;
};

/// What a view in perspective shows, for leaving out what cannot matter; it decides nothing.
///
/// Points are relative to the eye. Where (x, y) are along the paper and z is the distance before
/// the eye, u and v are x/z and y/z times 2^40, and w, which grows towards the viewer, is a
/// constant times 1/z: a projective map, under which lines stay lines and planes planes.
class PerspectiveMap {
 public:
  /// A unit of x/z.
  static constexpr double kUnit = 1099511627776.0;  // 2^40
  /// Beyond this lies nothing that is drawn: boxes end there.
  static constexpr double kRim = 64 * kUnit;

  /// `nearest`: about the least depth of what is drawn.
  PerspectiveMap(const View& view, double nearest) : axes_(axes_of(view)), nearest_(nearest) {}

  /// Nothing for what is not clearly before the eye. `size` bounds the coordinates that p was
  /// computed from.
  [[nodiscard]] std::optional<PerspectivePoint> at(const geometry::Vec3d& p, double size) const;
  [[nodiscard]] std::optional<PerspectivePoint> at(const geometry::Vec3l& p) const;

  /// Of an edge the part between two parameters; nothing where that cannot be told.
  [[nodiscard]] std::optional<PerspectiveSegment> segment(const geometry::Vec3l& a,
                                                          const geometry::Vec3l& b, double from,
                                                          double to) const;

  /// A box that holds what the convex hull of the corners shows before the eye, out to kRim;
  /// empty where it is nothing.
  [[nodiscard]] ViewBox box_of(std::span<const geometry::Vec3l> corners) const;

  [[nodiscard]] const ViewAxes& axes() const { return axes_; }
  [[nodiscard]] double nearest() const { return nearest_; }

 private:
  ViewAxes axes_;
  double nearest_;
};

}  // namespace strake::hlr
