// SPDX-License-Identifier: Apache-2.0
#include "geometry/interior_depth/bounds/inscribed_ball.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/numeric/vector_math.hpp"
#include "strake/geometry/depth.hpp"

namespace strake::geometry {
namespace {

using Row = std::array<double, 4>;
using BasisMatrix = std::array<Row, 4>;

constexpr double kPivot = 1e-11;
constexpr double kPivotEps = std::numeric_limits<double>::epsilon();

Row row_of(const BallConstraint& c) { return {c.normal.x, c.normal.y, c.normal.z, c.weight}; }

/// Gauss-Jordan with row pivoting; nothing when singular to working precision.
std::optional<BasisMatrix> inverse(BasisMatrix m) {
  BasisMatrix inv{Row{1, 0, 0, 0}, Row{0, 1, 0, 0}, Row{0, 0, 1, 0}, Row{0, 0, 0, 1}};
  for (std::size_t k = 0; k < 4; ++k) {
    std::size_t best = k;
    for (std::size_t i = k + 1; i < 4; ++i)
      if (std::fabs(m[i][k]) > std::fabs(m[best][k])) best = i;
    if (!(std::fabs(m[best][k]) > 1e-13)) return std::nullopt;
    std::swap(m[k], m[best]);
    std::swap(inv[k], inv[best]);
    const double scale = 1 / m[k][k];
    for (std::size_t j = 0; j < 4; ++j) {
      m[k][j] *= scale;
      inv[k][j] *= scale;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      if (i == k) continue;
      const double f = m[i][k];
      for (std::size_t j = 0; j < 4; ++j) {
        m[i][j] -= f * m[k][j];
        inv[i][j] -= f * inv[k][j];
      }
    }
  }
  return inv;
}

/// A sum of constraints, none times less than nothing.
struct Combination {
  Row row{};
  double bound = 0;
  double magnitude = 0, weight = 0;  ///< of what was added

  void add(const BallConstraint& c, double times) {
    const Row a = row_of(c);
    for (std::size_t k = 0; k < 4; ++k) row[k] += times * a[k];
    bound += times * c.offset;
    magnitude += times * std::fabs(c.offset);
    weight += times;
  }
  /// The most that the row gives for any point in the extent.
  [[nodiscard]] double reach(double extent) const {
    double largest = 0;
    for (const double v : row) largest += std::fabs(v);
    return largest * extent * (1 + 16 * kPivotEps);
  }
  /// What rounding may have changed.
  [[nodiscard]] double error(double extent) const {
    return 16 * kPivotEps * (magnitude + weight * extent);
  }
};

}  // namespace

DualSimplex::DualSimplex(std::span<const BallConstraint, 4> first, double extent)
    : extent_(extent) {
  std::copy(first.begin(), first.end(), rows_.begin());
}

bool DualSimplex::load() {
  BasisMatrix m;
  for (std::size_t i = 0; i < 4; ++i) m[i] = row_of(rows_[i]);
  const auto inv = inverse(m);
  if (!inv) return false;
  inverse_ = *inv;
  for (std::size_t k = 0; k < 4; ++k) {
    z_[k] = 0;
    for (std::size_t i = 0; i < 4; ++i) z_[k] += inverse_[k][i] * rows_[i].offset;
  }
  y_ = inverse_[3];
  return true;
}

/// r = e·z for feasible z = (x, r); with rest = sum y a - e, r <= sum y b + |rest|·extent.
double DualSimplex::proven_upper() const {
  Combination sum{.row = {0, 0, 0, -1}};
  for (std::size_t i = 0; i < 4; ++i) sum.add(rows_[i], std::max(y_[i], 0.0));
  return sum.bound + sum.reach(extent_) + sum.error(extent_) + 16 * kPivotEps * extent_;
}

bool DualSimplex::holds(std::size_t id) const {
  return std::find(ids_.begin(), ids_.end(), id) != ids_.end();
}

/// How much of the i-th row is in another one.
double DualSimplex::share(const BallConstraint& c, std::size_t i) const {
  const Row a = row_of(c);
  double w = 0;
  for (std::size_t k = 0; k < 4; ++k) w += a[k] * inverse_[k][i];
  return w;
}

double DualSimplex::excess_error(const BallConstraint& c) const {
  double largest = 0;
  for (std::size_t i = 0; i < 4; ++i)
    largest += std::fabs(share(c, i)) *
               (std::fabs(excess(rows_[i])) + kPivotEps * (std::fabs(rows_[i].offset) + extent_));
  return largest;
}

/// With a the entering row and rest = a + sum w a_i, all z that satisfy the five constraints have
/// rest·z <= b + sum w b_i: none has where that is less than rest can be for any z in the extent.
bool DualSimplex::proves_empty(const BallConstraint& entering) const {
  Combination sum;
  sum.add(entering, 1);
  for (std::size_t i = 0; i < 4; ++i) sum.add(rows_[i], std::max(-share(entering, i), 0.0));
  return sum.bound < -(sum.reach(extent_) + sum.error(extent_));
}

bool DualSimplex::exchange(const BallConstraint& entering, std::size_t id) {
  std::optional<std::size_t> leaving;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 4; ++i) {
    const double w = share(entering, i);
    if (!(w > kPivot)) continue;
    const double ratio = std::max(y_[i], 0.0) / w;
    if (ratio < best || (ratio == best && leaving && ids_[i] < ids_[*leaving])) {
      best = ratio;
      leaving = i;
    }
  }
  if (!leaving) return false;
  rows_[*leaving] = entering;
  ids_[*leaving] = id;
  return true;
}

namespace {

constexpr int kMaxPivots = 500;
/// Steps without gain after which only certain violations count: of constraints along nearly the
/// same planes, as those of equal or touching bodies, each may otherwise be violated by the
/// rounding of a vertex of the others, so that they replace each other for ever. Without this limit
/// 440 of 600 problems of copies took all of kMaxPivots steps (decision 0021).
constexpr int kDoubtSteps = 3;
/// Steps without gain after which the first violated constraint is taken, not the most.
constexpr int kStallSteps = 24;

/// The most violated constraint, or the first one.
std::optional<std::size_t> violated(const InscribedBallProblem& p, const DualSimplex& simplex,
                                    double tolerance, int stalled) {
  const bool first = stalled > kStallSteps, only_certain = stalled > kDoubtSteps;
  double worst = tolerance;
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < p.constraints.size(); ++i) {
    const double excess = simplex.excess(p.constraints[i]);
    if (!(excess > worst) || simplex.holds(i)) continue;
    if (only_certain && !(excess > simplex.excess_error(p.constraints[i]))) continue;
    found = i;
    if (first) break;
    worst = excess;
  }
  return found;
}

}  // namespace

InscribedBall largest_inscribed_ball(const InscribedBallProblem& problem) {
  const double tolerance = 1e-9 + 1e-13 * problem.extent;
  DualSimplex simplex(problem.constraints.first<4>(), problem.extent);
  InscribedBall result;
  result.upper = problem.extent;
  int stalled = 0;
  for (int step = 0; step < kMaxPivots && simplex.load(); ++step) {
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

namespace {

/// A direction whose cosine with another is no more than this counts as perpendicular to it: more
/// than the angle error of a face by the snap, so that two coplanar faces hold a point only across
/// them.
constexpr double kPerpendicular = 1e-3;
/// A boundary that is parallel to a direction but for this is not met along it.
constexpr double kAlong = 1e-9;
/// A boundary whose multiplier is less hardly holds the ball: it gives way to a move of the ball
/// that costs a thousandth of the move.
constexpr double kHolds = 1e-3;

/// Orthonormal directions that a point may still be moved along.
class FreeDirections {
 public:
  [[nodiscard]] std::size_t count() const { return axes_.size(); }
  [[nodiscard]] const Vec3d& first() const { return axes_.front(); }

  [[nodiscard]] Vec3d part_of(const Vec3d& v) const {
    Vec3d sum;
    for (const Vec3d& axis : axes_) sum = sum + axis * dot(axis, v);
    return sum;
  }

  /// No longer along `v`.
  void hold(const Vec3d& v) {
    const Vec3d along = part_of(v);
    if (!(length(along) > kPerpendicular)) return;
    std::vector<Vec3d> left{unit(along)};
    for (const Vec3d& axis : axes_) {
      Vec3d rest = axis;
      for (const Vec3d& other : left) rest = rest - other * dot(other, rest);
      // Of two or three unit vectors that span the same, one has at least so much beside the rest.
      constexpr double kMin = 0.5;
      if (left.size() < axes_.size() && length(rest) > kMin) left.push_back(unit(rest));
    }
    left.erase(left.begin());
    axes_ = std::move(left);
  }

 private:
  std::vector<Vec3d> axes_{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
};

/// The region as it is cut by the directions that are free, about a point of it.
std::vector<BallConstraint> section(std::span<const BallConstraint> region, const Vec3d& from,
                                    const FreeDirections& free, double extent) {
  std::vector<BallConstraint> rows;
  rows.reserve(4 + region.size());
  // They start the search, too far off to matter.
  constexpr double kFar = 8;
  for (const Vec3d& n : tetrahedral_directions()) rows.push_back({n, 1, kFar * extent});
  for (const BallConstraint& c : region) {
    const Vec3d beside = free.part_of(c.normal);
    const double share = length(beside);
    if (!(share > kAlong)) continue;
    const double room = std::max(c.offset - dot(c.normal, from), 0.0);
    rows.push_back({beside * (1 / share), 1, room / share});
  }
  return rows;
}

/// The middle of the chord through a point.
double middle_of_chord(std::span<const BallConstraint> region, const Vec3d& from,
                       const Vec3d& along, double extent) {
  double lo = -2 * extent, hi = 2 * extent;
  for (const BallConstraint& c : region) {
    const double share = dot(c.normal, along);
    if (!(std::fabs(share) > kAlong)) continue;
    const double room = std::max(c.offset - dot(c.normal, from), 0.0) / share;
    if (share > 0)
      hi = std::min(hi, room);
    else
      lo = std::max(lo, room);
  }
  return (lo + hi) / 2;
}

}  // namespace

Vec3d to_chebyshev_centre(std::span<const BallConstraint> region, double extent) {
  Vec3d way;
  FreeDirections free;
  while (free.count() > 1) {
    const std::vector<BallConstraint> rows = section(region, way, free, extent);
    const InscribedBall ball = largest_inscribed_ball({rows, extent});
    way = way + free.part_of(ball.x);
    const std::size_t before = free.count();
    for (const InscribedBall::ActiveConstraint& held : ball.held)
      if (held.multiplier > kHolds) free.hold(rows[held.by].normal);
    if (free.count() == before) return way;
  }
  if (free.count() == 1)
    way = way + free.first() * middle_of_chord(region, way, free.first(), extent);
  return way;
}

}  // namespace strake::geometry
