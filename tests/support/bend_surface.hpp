// SPDX-License-Identifier: Apache-2.0
#pragma once

// A bend by its formulas: its skin by the angle of the sweep and that in the section, and where an
// eye sees it turn away.

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/numeric/trig.hpp"
#include "strake/geometry/primitive.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::test {

struct BendSurface {
  geometry::CircularTorusPrimitive bend;
  geometry::Vec3d eye;

  [[nodiscard]] geometry::Vec3d at(double sweep, double place) const {
    const double out = bend.centre_radius + bend.tube_radius * std::cos(place);
    return {out * std::cos(sweep), out * std::sin(sweep), bend.tube_radius * std::sin(place)};
  }
  [[nodiscard]] static geometry::Vec3d normal(double sweep, double place) {
    return {std::cos(place) * std::cos(sweep), std::cos(place) * std::sin(sweep), std::sin(place)};
  }
  /// How much the skin looks towards the eye, as the sine of an angle.
  [[nodiscard]] double facing(double sweep, double place) const {
    const geometry::Vec3d sight = eye - at(sweep, place);
    return dot(normal(sweep, place), sight) / std::sqrt(dot(sight, sight));
  }
  /// Of a point, the angles of the sweep and in the section.
  [[nodiscard]] std::pair<double, double> angles_of(const geometry::Vec3d& p) const {
    double sweep = std::atan2(p.y, p.x);
    if (sweep < -1e-9) sweep += 2 * geometry::kPi;
    return {sweep, std::atan2(p.z, std::hypot(p.x, p.y) - bend.centre_radius)};
  }
  /// The two places in a section where its circle turns away from the eye.
  [[nodiscard]] std::optional<std::pair<double, double>> contour(double sweep) const {
    const double out = eye.x * std::cos(sweep) + eye.y * std::sin(sweep) - bend.centre_radius;
    const double distance = std::hypot(out, eye.z);
    if (!(distance > bend.tube_radius)) return std::nullopt;
    const double half = std::acos(bend.tube_radius / distance), middle = std::atan2(eye.z, out);
    return std::pair(middle - half, middle + half);
  }
  /// The sections, by the angle of the sweep, in which the contour is at a place.
  [[nodiscard]] std::vector<double> sections_at(double place) const {
    const double level = std::hypot(eye.x, eye.y), cosine = std::cos(place);
    const double out = (bend.tube_radius - eye.z * std::sin(place)) / cosine + bend.centre_radius;
    std::vector<double> found;
    if (std::fabs(cosine) < 1e-6 || !(std::fabs(out) < level)) return found;
    for (const double side : {-1.0, 1.0}) {
      double sweep = std::atan2(eye.y, eye.x) + side * std::acos(out / level);
      sweep -= std::floor(sweep / (2 * geometry::kPi)) * 2 * geometry::kPi;
      if (sweep < bend.angle) found.push_back(sweep);
    }
    return found;
  }
  /// How far a point is outside the body, negative inside; of the tube alone, between its ends.
  [[nodiscard]] double outside(const geometry::Vec3d& p) const {
    const double sweep = angles_of(p).first;
    const double past = sweep - std::min(bend.angle, 2 * geometry::kPi);
    const double level = std::hypot(p.x, p.y);
    const double tube = std::hypot(level - bend.centre_radius, p.z) - bend.tube_radius;
    if (past <= 0) return tube;
    // Beyond an end: at least as far as from its plane.
    const double before = 2 * geometry::kPi - sweep;
    return std::max(tube, level * std::sin(std::min({past, before, geometry::kPi / 2})));
  }
};

}  // namespace strake::test
