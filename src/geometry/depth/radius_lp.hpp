// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// One constraint normal·x + weight·r <= offset of a RadiusProblem; weight is 0 or more.
struct RadiusConstraint {
  Vec3d normal;
  double weight = 0;
  double offset = 0;
};

/// "Where is the largest r?": maximise r over (x, r) under linear constraints. The largest ball
/// inside one convex body whose centre lies in another is such a problem.
struct RadiusProblem {
  /// The first four must be dual feasible: some y > 0 with sum y·(normal, weight) = (0, 0, 0, 1),
  /// as the four tetrahedral directions with weight 1 are.
  std::span<const RadiusConstraint> constraints;
  /// Bound on |x_k| and r over the points that matter, for the certificate.
  double extent = 0;
};

struct RadiusSolution {
  Vec3d x;
  double r = 0;
  /// Certified: no feasible (x, r) within the extent has a greater r, by weak duality and with
  /// every rounding counted. Holds even when the iteration stopped early.
  double upper = 0;
  bool optimal = false;
  int steps = 0;  ///< vertices looked at: the work
  /// The constraints that meet at (x, r), by number: were one a unit looser, r would be larger by
  /// its multiplier.
  struct Held {
    std::size_t by = 0;
    double multiplier = 0;
  };
  std::array<Held, 4> held{};
};

/// Dual simplex method with four-row bases (Lemke 1954), most violated constraint first and least
/// index first once the objective stalls (Bland 1977), so that it ends.
[[nodiscard]] RadiusSolution maximise_radius(const RadiusProblem& problem);

}  // namespace strake::geometry
