// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// One constraint normal·x + weight·r <= offset of a InscribedBallProblem; weight is 0 or more.
struct BallConstraint {
  Vec3d normal;
  double weight = 0;
  double offset = 0;
};

/// "Where is the largest r?": maximise r over (x, r) under linear constraints. The largest ball
/// inside one convex body whose centre lies in another is such a problem.
struct InscribedBallProblem {
  /// The first four must be dual feasible: some y > 0 with sum y·(normal, weight) = (0, 0, 0, 1),
  /// as the four tetrahedral directions with weight 1 are.
  std::span<const BallConstraint> constraints;
  /// Bound on |x_k| and r over the points that matter, for the certificate.
  double extent = 0;
};

struct InscribedBall {
  Vec3d x;
  double r = 0;
  /// Certified: no feasible (x, r) within the extent has a greater r, by weak duality and with
  /// every rounding counted. Holds even when the iteration stopped early.
  double upper = 0;
  bool optimal = false;
  int steps = 0;  ///< vertices looked at: the work
  /// The constraints that meet at (x, r), by number: were one a unit looser, r would be larger by
  /// its multiplier.
  struct ActiveConstraint {
    std::size_t by = 0;
    double multiplier = 0;
  };
  std::array<ActiveConstraint, 4> held{};
};

/// Dual simplex method with four-row bases (Lemke 1954), most violated constraint first and least
/// index first once the objective stalls (Bland 1977), so that it ends.
[[nodiscard]] InscribedBall largest_inscribed_ball(const InscribedBallProblem& problem);

/// The dual simplex method of largest_inscribed_ball() one exchange at a time, for whoever finds
/// the next constraint himself: there may be infinitely many.
class DualSimplex {
 public:
  /// The first four constraints must be dual feasible: see InscribedBallProblem.
  DualSimplex(std::span<const BallConstraint, 4> first, double extent);

  /// Vertex and multipliers of the present four; false when they are singular to working
  /// precision. To be asked after construction and after every exchange.
  [[nodiscard]] bool load();

  [[nodiscard]] Vec3d x() const { return {z_[0], z_[1], z_[2]}; }
  [[nodiscard]] double r() const { return z_[3]; }
  /// The upper bound on r that the present multipliers prove, every rounding counted.
  [[nodiscard]] double proven_upper() const;
  [[nodiscard]] double excess(const BallConstraint& c) const {
    return c.normal.x * z_[0] + c.normal.y * z_[1] + c.normal.z * z_[2] + c.weight * z_[3] -
           c.offset;
  }
  /// What rounding of the vertex may make of an excess: much where the present four are along
  /// nearly the same planes.
  [[nodiscard]] double excess_error(const BallConstraint& c) const;
  [[nodiscard]] bool holds(std::size_t id) const;
  /// Of the present four.
  [[nodiscard]] const std::array<std::size_t, 4>& ids() const { return ids_; }
  [[nodiscard]] const std::array<double, 4>& multipliers() const { return y_; }

  /// A violated constraint takes the place of one of the four; false when none gives way. `id`
  /// breaks ties; the first four have 0 to 3.
  [[nodiscard]] bool exchange(const BallConstraint& entering, std::size_t id);
  /// Whether it provably leaves no point with 0 <= r beside the present four (Farkas), every
  /// rounding counted. To be asked where exchange() found none to give way.
  [[nodiscard]] bool proves_empty(const BallConstraint& entering) const;

 private:
  using Row = std::array<double, 4>;

  [[nodiscard]] double share(const BallConstraint& c, std::size_t i) const;

  std::array<BallConstraint, 4> rows_;
  std::array<std::size_t, 4> ids_{0, 1, 2, 3};
  double extent_ = 0;
  std::array<Row, 4> inverse_{};
  Row z_{}, y_{};
};

/// The way from the origin to the middle of a convex region that holds it: the point farthest from
/// the nearest boundaries; where these leave it free, as the sides of a bar do along the bar,
/// farthest from the next ones, and so on. The middle of a box or prism, whatever its lengths.
/// Weights of the constraints mean nothing; `extent` bounds the region. Where the origin breaks a
/// constraint, that is as if it were on its boundary.
[[nodiscard]] Vec3d to_chebyshev_centre(std::span<const BallConstraint> region, double extent);

}  // namespace strake::geometry
