// SPDX-License-Identifier: Apache-2.0
#include "geometry/depth/radius_lp.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>

#include "geometry/depth/radius_simplex.hpp"

namespace strake::geometry {
namespace {

constexpr int kMaxSteps = 500;
constexpr int kStallSteps = 24;

/// The most violated constraint, or the first one.
std::optional<std::size_t> violated(const RadiusProblem& p, const RadiusSimplex& simplex,
                                    double tolerance, bool first) {
  double worst = tolerance;
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < p.constraints.size(); ++i) {
    const double excess = simplex.excess(p.constraints[i]);
    if (!(excess > worst) || simplex.holds(i)) continue;
    found = i;
    if (first) break;
    worst = excess;
  }
  return found;
}

}  // namespace

RadiusSolution maximise_radius(const RadiusProblem& problem) {
  const double tolerance = 1e-9 + 1e-13 * problem.extent;
  RadiusSimplex simplex(problem.constraints.first<4>(), problem.extent);
  RadiusSolution result;
  result.upper = problem.extent;
  int stalled = 0;
  for (int step = 0; step < kMaxSteps && simplex.load(); ++step) {
    const double bound = simplex.proven_upper();
    stalled = bound < result.upper - tolerance ? 0 : stalled + 1;
    result.upper = std::min(result.upper, bound);
    result.x = simplex.x();
    result.r = simplex.r();
    const auto entering = violated(problem, simplex, tolerance, stalled > kStallSteps);
    if (!entering) {
      result.optimal = true;
      break;
    }
    if (!simplex.exchange(problem.constraints[*entering], *entering)) break;
  }
  return result;
}

}  // namespace strake::geometry
