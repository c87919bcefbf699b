// SPDX-License-Identifier: Apache-2.0
#include "geometry/primitives/bend_contour.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/numeric/trig.hpp"

namespace strake::geometry::tessellation {

BendContour::BendContour(const CircularTorusPrimitive& p, const Vec3d& eye)
    : centre_radius_(p.centre_radius),
      tube_radius_(p.tube_radius),
      towards_(arc_tan2(eye.y, eye.x)),
      level_(std::sqrt(eye.x * eye.x + eye.y * eye.y)),
      up_(eye.z),
      sideways_(std::sqrt(std::max(0.0, (level_ - centre_radius_) * (level_ + centre_radius_)))) {}

bool BendContour::is_clear() const {
  const double out = level_ - centre_radius_;
  return std::sqrt(out * out + up_ * up_) > kNearestEye * tube_radius_;
}

double BendContour::outward(double angle) const {
  return level_ * sin_cos(angle - towards_).cos - centre_radius_;
}

std::optional<EyeContour> BendContour::at(double angle) const {
  const double out = outward(angle), distance = std::sqrt(out * out + up_ * up_);
  if (!(distance > tube_radius_)) return std::nullopt;
  const double middle = arc_tan2(up_, out), half = arc_cos(tube_radius_ / distance);
  return EyeContour{middle - half, middle + half};
}

double BendContour::bend_along_sight(double angle, double place) const {
  const SinCos p = sin_cos(place);
  const double along = level_ * sin_cos(angle - towards_).sin;
  const double across = up_ * p.cos - outward(angle) * p.sin;
  return across * across / tube_radius_ +
         along * along * p.cos / (centre_radius_ + tube_radius_ * p.cos);
}

std::vector<double> BendContour::sections_at(double out) const {
  if (!(std::fabs(out) < level_)) return {};
  const double away = arc_cos(out / level_);
  return {towards_ - away, towards_ + away};
}

std::vector<double> BendContour::meetings(double narrowest) const {
  const double square = (tube_radius_ - up_) * (tube_radius_ + up_);
  const double half = square > 0 ? std::sqrt(square) : 0;
  // Where the eye is as high as the top of the tube, both lines touch each other.
  const double touching = std::sqrt(std::fabs(square));
  if (2 * touching * centre_radius_ < narrowest * sideways_) return sections_at(centre_radius_);
  std::vector<double> all;
  if (half == 0) return all;
  for (const double out : {centre_radius_ - half, centre_radius_ + half})
    for (const double angle : sections_at(out)) all.push_back(angle);
  return all;
}

double BendContour::meeting_place(double angle) const { return arc_tan2(up_, outward(angle)); }

std::vector<double> BendContour::seen_along() const { return sections_at(centre_radius_); }

double BendContour::turning() const { return (tube_radius_ + std::fabs(up_)) / sideways_; }

}  // namespace strake::geometry::tessellation
