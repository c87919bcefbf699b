// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// One constraint normal·x + weight·r <= offset of an InscribedBallProblem; weight is 0 or more.
struct BallConstraint {
  Vec3d normal;
  double weight = 0;
  double offset = 0;
};

/// The linear program that maximises r over (x, r) under linear constraints. The largest ball
/// inside one convex body whose centre lies in another is such a problem.
struct InscribedBallProblem {
  /// The first four must be dual feasible: some y > 0 with sum y·(normal, weight) = (0, 0, 0, 1),
  /// as the four tetrahedral directions with weight 1 are.
  std::span<const BallConstraint> constraints;
  /// Bound on |x_k| and r over the relevant points, for the certificate.
  double extent = 0;
};

struct InscribedBall {
  Vec3d x;
  double r = 0;
  /// Certified: no feasible (x, r) within the extent has a greater r, by weak duality and with
  /// every rounding counted. This holds even when the iteration stopped early.
  double upper = 0;
  bool optimal = false;
  int steps = 0;  ///< vertices visited: the work
  /// The constraints active at (x, r), by number: loosening one by a unit raises r by its
  /// multiplier.
  struct ActiveConstraint {
    std::size_t by = 0;
    double multiplier = 0;
  };
  std::array<ActiveConstraint, 4> held{};
};

/// Solves the program by the dual simplex method with four-row bases (Lemke 1954), most violated
/// constraint first and least index first once the objective stalls (Bland 1977), so that it ends.
[[nodiscard]] InscribedBall largest_inscribed_ball(const InscribedBallProblem& problem);

/// The dual simplex method of largest_inscribed_ball() one exchange at a time, for callers that
/// generate the constraints, of which there may be infinitely many.
class DualSimplex {
 public:
  /// The first four constraints must be dual feasible: see InscribedBallProblem.
  DualSimplex(std::span<const BallConstraint, 4> first, double extent);

  /// Computes vertex and multipliers of the present four; false when they are singular to working
  /// precision. Call it after construction and after every exchange.
  [[nodiscard]] bool load();

  [[nodiscard]] Vec3d x() const { return {z_[0], z_[1], z_[2]}; }
  [[nodiscard]] double r() const { return z_[3]; }
  /// Returns the upper bound on r that the present multipliers prove, every rounding counted.
  [[nodiscard]] double proven_upper() const;
  [[nodiscard]] double excess(const BallConstraint& c) const {
    return c.normal.x * z_[0] + c.normal.y * z_[1] + c.normal.z * z_[2] + c.weight * z_[3] -
           c.offset;
  }
  /// Returns the error of an excess by rounding of the vertex: large where the present four are
  /// nearly parallel.
  [[nodiscard]] double excess_error(const BallConstraint& c) const;
  [[nodiscard]] bool holds(std::size_t id) const;
  /// Returns the ids of the present four.
  [[nodiscard]] const std::array<std::size_t, 4>& ids() const { return ids_; }
  [[nodiscard]] const std::array<double, 4>& multipliers() const { return y_; }

  /// Replaces one of the four by a violated constraint; false when none can leave. `id` breaks
  /// ties; the first four have 0 to 3.
  [[nodiscard]] bool exchange(const BallConstraint& entering, std::size_t id);
  /// Whether a constraint and the present four provably admit no point with 0 <= r (Farkas), every
  /// rounding counted. Call it where exchange() returned false.
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

/// Returns the vector from the origin to the centre of a convex region that contains it: the point
/// farthest from the nearest boundaries; where these leave it free, as the sides of a bar do along
/// the bar, farthest from the next ones, and so on. For a box or prism it is the centre, whatever
/// the lengths. Weights of the constraints are ignored; `extent` bounds the region. A constraint
/// that the origin violates counts as if the origin were on its boundary.
[[nodiscard]] Vec3d to_chebyshev_centre(std::span<const BallConstraint> region, double extent);

}  // namespace strake::geometry
