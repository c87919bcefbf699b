// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "geometry/depth/radius_lp.hpp"

namespace strake::geometry {

/// The dual simplex method of maximise_radius() one exchange at a time, for whoever finds the next
/// constraint himself: there may be infinitely many.
class RadiusSimplex {
 public:
  /// The first four constraints must be dual feasible: see RadiusProblem.
  RadiusSimplex(std::span<const RadiusConstraint, 4> first, double extent);

  /// Vertex and multipliers of the present four; false when they are singular to working
  /// precision. To be asked after construction and after every exchange.
  [[nodiscard]] bool load();

  [[nodiscard]] Vec3d x() const { return {z_[0], z_[1], z_[2]}; }
  [[nodiscard]] double r() const { return z_[3]; }
  /// The upper bound on r that the present multipliers prove, every rounding counted.
  [[nodiscard]] double proven_upper() const;
  [[nodiscard]] double excess(const RadiusConstraint& c) const {
    return c.normal.x * z_[0] + c.normal.y * z_[1] + c.normal.z * z_[2] + c.weight * z_[3] -
           c.offset;
  }
  /// What rounding of the vertex may make of an excess: much where the present four are along
  /// nearly the same planes.
  [[nodiscard]] double doubt(const RadiusConstraint& c) const;
  [[nodiscard]] bool holds(std::size_t id) const;
  /// Of the present four.
  [[nodiscard]] const std::array<std::size_t, 4>& ids() const { return ids_; }
  [[nodiscard]] const std::array<double, 4>& multipliers() const { return y_; }

  /// A violated constraint takes the place of one of the four; false when none gives way. `id`
  /// breaks ties; the first four have 0 to 3.
  [[nodiscard]] bool exchange(const RadiusConstraint& entering, std::size_t id);
  /// Whether it provably leaves no point with 0 <= r beside the present four (Farkas), every
  /// rounding counted. To be asked where exchange() found none to give way.
  [[nodiscard]] bool proves_empty(const RadiusConstraint& entering) const;

 private:
  using Row = std::array<double, 4>;

  [[nodiscard]] double share(const RadiusConstraint& c, std::size_t i) const;

  std::array<RadiusConstraint, 4> rows_;
  std::array<std::size_t, 4> ids_{0, 1, 2, 3};
  double extent_ = 0;
  std::array<Row, 4> inverse_{};
  Row z_{}, y_{};
};

}  // namespace strake::geometry
