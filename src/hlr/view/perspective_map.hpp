// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "hlr/view/projection.hpp"
#include "hlr/view/view_bvh.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::hlr {

/// A point as a PerspectiveMap maps it, off by `error_bound` at most in each coordinate.
struct PerspectivePoint {
  double u = 0, v = 0, w = 0;
  double depth = 0;  ///< distance before the eye, grid units
  double error_bound = 0;
};

/// The drawn part of an edge under a PerspectiveMap, by the parameters of the edge: a straight
/// segment there too, along which parameters run projectively.
class PerspectiveSegment {
 public:
  PerspectiveSegment() = default;
  PerspectiveSegment(const PerspectivePoint& a, const PerspectivePoint& b, double from, double to);

  [[nodiscard]] const PerspectivePoint& a() const { return a_; }
  [[nodiscard]] const PerspectivePoint& b() const { return b_; }
  /// Returns the largest error of a point of the segment whose parameter is known to the last
  /// place.
  [[nodiscard]] double error_bound() const { return error_bound_; }
  /// Converts a parameter of the edge to the fraction of the segment from a to b, and back.
  [[nodiscard]] double fraction(double t) const;
  [[nodiscard]] double parameter(double fraction) const;
  /// Returns whether one end is so much nearer than the other that parameters lose their digits.
  [[nodiscard]] bool is_steep() const;

  /// Returns a query about the part between two parameters.
  [[nodiscard]] SegmentQuery make_query(double from, double to) const;
  [[nodiscard]] ViewBox box() const;

 private:
  PerspectivePoint a_, b_;
  double from_ = 0, to_ = 1, error_bound_ = 0;
};

/// The perspective projection in doubles with error bounds, for culling: exact tests decide.
///
/// Points are relative to the eye. Where (x, y) are along the paper and z is the distance before
/// the eye, u and v are x/z and y/z times 2^40, and w, which grows towards the viewer, is a
/// constant times 1/z: a projective map, under which lines stay lines and planes planes.
class PerspectiveMap {
 public:
  /// A unit of x/z.
  static constexpr double kUnit = 1099511627776.0;  // 2^40
  /// Nothing that is drawn lies beyond this: boxes end there.
  static constexpr double kPaperLimit = 64 * kUnit;

  /// `nearest` is about the least depth of what is drawn.
  PerspectiveMap(const View& view, double nearest) : axes_(axes_of(view)), nearest_(nearest) {}

  /// Maps a point; nothing where it is not clearly before the eye. `size` bounds the coordinates
  /// that p was computed from.
  [[nodiscard]] std::optional<PerspectivePoint> at(const geometry::Vec3d& p, double size) const;
  [[nodiscard]] std::optional<PerspectivePoint> at(const geometry::Vec3l& p) const;

  /// Maps the part of an edge between two parameters; nothing where that is uncertain.
  [[nodiscard]] std::optional<PerspectiveSegment> segment(const geometry::Vec3l& a,
                                                          const geometry::Vec3l& b, double from,
                                                          double to) const;

  /// Returns a box that holds the image of that part of the corners' convex hull that lies before
  /// the eye, out to kPaperLimit; empty where there is none.
  [[nodiscard]] ViewBox box_of(std::span<const geometry::Vec3l> corners) const;

  [[nodiscard]] const ViewAxes& axes() const { return axes_; }
  [[nodiscard]] double nearest() const { return nearest_; }

 private:
  ViewAxes axes_;
  double nearest_;
};

}  // namespace strake::hlr
