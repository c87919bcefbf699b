// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "geometry/primitives/mesh_builder.hpp"

// Where a bend turns away from an eye. In the plane of a section, which holds the axis, the skin's
// normals are those of the section's circle, so the contour is where the tangents from the eye's
// image in that plane touch the circle.

namespace strake::geometry::tessellation {

class BendContour {
 public:
  /// A bend whose sections are circles of `tube_radius`, seen from an eye in its frame.
  BendContour(const CircularTorusPrimitive& p, const Vec3d& eye);

  /// Returns where the eye lies in the plane of a section, from the circle's middle: outward, and
  /// up.
  [[nodiscard]] double outward(double angle) const;
  [[nodiscard]] double up() const { return up_; }
  /// Returns the angle of the sweep at which the eye stands.
  [[nodiscard]] double towards() const { return towards_; }

  /// Whether the eye is outside the whole ring and not at its skin.
  [[nodiscard]] bool is_clear() const;

  /// Returns the contour in the section at an angle of the sweep; none where the whole section
  /// looks away.
  [[nodiscard]] std::optional<EyeContour> at(double angle) const;

  /// Returns which way the skin bends along the sight at a place: at the contour positive where the
  /// sight touches the skin from outside, negative where it runs on into the body, which hides the
  /// contour there. At 0 is a cusp of the contour on paper.
  [[nodiscard]] double bend_along_sight(double angle, double place) const;

  /// Returns where both lines of the contour meet and end: there is none from one such section to
  /// the next. One that stands for two has no width to speak of, `narrowest`, between them.
  [[nodiscard]] std::vector<double> meetings(double narrowest) const;
  /// Returns the place in its section where they do.
  [[nodiscard]] double meeting_place(double angle) const;

  /// Returns the sections which the eye sees along the tube: before these the contour is about the
  /// highest and the lowest line, behind them the lowest and the highest.
  [[nodiscard]] std::vector<double> seen_along() const;
  /// Returns about half the angle of the sweep in which the contour turns from the ones to the
  /// others.
  [[nodiscard]] double turning() const;

 private:
  /// Returns the angles, two each turn, of sections in which the eye lies `out` from the axis.
  [[nodiscard]] std::vector<double> sections_at(double out) const;

  double centre_radius_, tube_radius_;
  double towards_ = 0;
  double level_ = 0;  ///< of the eye, from the axis
  double up_ = 0;
  double sideways_ = 0;  ///< from the plane of a section that the eye sees along the tube; 0: none
};

}  // namespace strake::geometry::tessellation
