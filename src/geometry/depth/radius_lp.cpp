// SPDX-License-Identifier: Apache-2.0
#include "geometry/depth/radius_lp.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>

#include "geometry/depth/radius_simplex.hpp"

namespace strake::geometry {
namespace {

constexpr int kMaxSteps = 500;
/// Steps without gain after which only certain violations count: of constraints along nearly the
/// same planes, as those of equal or flush bodies, each may else be off by the rounding of a vertex
/// of the others, so that they take each other's place for ever.
constexpr int kDoubtSteps = 3;
/// Steps without gain after which the first violated constraint is taken, not the most.
constexpr int kStallSteps = 24;

/// The most violated constraint, or the first one.
std::optional<std::size_t> violated(const RadiusProblem& p, const RadiusSimplex& simplex,
                                    double tolerance, int stalled) {
  const bool first = stalled > kStallSteps, only_certain = stalled > kDoubtSteps;
  double worst = tolerance;
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < p.constraints.size(); ++i) {
    const double excess = simplex.excess(p.constraints[i]);
    if (!(excess > worst) || simplex.holds(i)) continue;
    if (only_certain && !(excess > simplex.doubt(p.constraints[i]))) continue;
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
    ++result.steps;
    const double bound = simplex.proven_upper();
    stalled = bound < result.upper - tolerance ? 0 : stalled + 1;
    result.upper = std::min(result.upper, bound);
    result.x = simplex.x();
    result.r = simplex.r();
    for (std::size_t i = 0; i < 4; ++i)
      result.held[i] = {simplex.ids()[i], simplex.multipliers()[i]};
    const auto entering = violated(problem, simplex, tolerance, stalled);
    if (!entering) {
      result.optimal = true;
      break;
    }
    if (!simplex.exchange(problem.constraints[*entering], *entering)) break;
  }
  return result;
}

}  // namespace strake::geometry
