// SPDX-License-Identifier: Apache-2.0
#include "geometry/depth/radius_lp.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace strake::geometry {
namespace {

using Row = std::array<double, 4>;
using Matrix = std::array<Row, 4>;
using Basis = std::array<std::size_t, 4>;

constexpr int kMaxSteps = 500;
constexpr int kStallSteps = 24;
constexpr double kPivot = 1e-11;

Row row_of(const RadiusConstraint& c) { return {c.normal.x, c.normal.y, c.normal.z, c.weight}; }

/// Gauss-Jordan with row pivoting; nothing when singular to working precision.
std::optional<Matrix> inverse(Matrix m) {
  Matrix inv{Row{1, 0, 0, 0}, Row{0, 1, 0, 0}, Row{0, 0, 1, 0}, Row{0, 0, 0, 1}};
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

/// The upper bound that the multipliers y of a basis prove. r = e·z for feasible z = (x, r); with
/// e = sum y a + rest, r <= sum y b + |rest|·extent.
double proven_upper(const RadiusProblem& p, const Basis& basis, const Row& y) {
  double bound = 0, magnitude = 0, weight = 0;
  Row rest{0, 0, 0, 1};
  for (std::size_t i = 0; i < 4; ++i) {
    const RadiusConstraint& c = p.constraints[basis[i]];
    const double yi = std::max(y[i], 0.0);
    const Row a = row_of(c);
    for (std::size_t k = 0; k < 4; ++k) rest[k] -= yi * a[k];
    bound += yi * c.offset;
    magnitude += yi * std::fabs(c.offset);
    weight += yi;
  }
  double slack = 0;
  for (const double v : rest) slack += std::fabs(v);
  constexpr double kEps = std::numeric_limits<double>::epsilon();
  return bound + slack * p.extent * (1 + 16 * kEps) + 16 * kEps * (magnitude + weight * p.extent) +
         16 * kEps * p.extent;
}

class DualSimplex {
 public:
  explicit DualSimplex(const RadiusProblem& problem)
      : p_(problem), tolerance_(1e-9 + 1e-13 * problem.extent) {}

  RadiusSolution solve() {
    RadiusSolution result;
    result.upper = p_.extent;
    int stalled = 0;
    for (int step = 0; step < kMaxSteps && load(); ++step) {
      const double bound = proven_upper(p_, basis_, y_);
      stalled = bound < result.upper - tolerance_ ? 0 : stalled + 1;
      result.upper = std::min(result.upper, bound);
      result.x = {z_[0], z_[1], z_[2]};
      result.r = z_[3];
      const auto entering = violated(stalled > kStallSteps);
      if (!entering) {
        result.optimal = true;
        break;
      }
      const auto leaving = ratio_test(*entering);
      if (!leaving) break;
      basis_[*leaving] = *entering;
    }
    return result;
  }

 private:
  /// Vertex and multipliers of the present basis.
  bool load() {
    Matrix m;
    for (std::size_t i = 0; i < 4; ++i) m[i] = row_of(p_.constraints[basis_[i]]);
    const auto inv = inverse(m);
    if (!inv) return false;
    inverse_ = *inv;
    for (std::size_t k = 0; k < 4; ++k) {
      z_[k] = 0;
      for (std::size_t i = 0; i < 4; ++i)
        z_[k] += inverse_[k][i] * p_.constraints[basis_[i]].offset;
    }
    y_ = inverse_[3];
    return true;
  }

  [[nodiscard]] std::optional<std::size_t> violated(bool first) const {
    double worst = tolerance_;
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < p_.constraints.size(); ++i) {
      const RadiusConstraint& c = p_.constraints[i];
      const double excess = c.normal.x * z_[0] + c.normal.y * z_[1] + c.normal.z * z_[2] +
                            c.weight * z_[3] - c.offset;
      if (!(excess > worst)) continue;
      if (std::find(basis_.begin(), basis_.end(), i) != basis_.end()) continue;
      found = i;
      if (first) break;
      worst = excess;
    }
    return found;
  }

  [[nodiscard]] std::optional<std::size_t> ratio_test(std::size_t entering) const {
    const Row a = row_of(p_.constraints[entering]);
    std::optional<std::size_t> leaving;
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 4; ++i) {
      double w = 0;
      for (std::size_t k = 0; k < 4; ++k) w += a[k] * inverse_[k][i];
      if (!(w > kPivot)) continue;
      const double ratio = std::max(y_[i], 0.0) / w;
      if (ratio < best || (ratio == best && leaving && basis_[i] < basis_[*leaving])) {
        best = ratio;
        leaving = i;
      }
    }
    return leaving;
  }

  const RadiusProblem& p_;
  double tolerance_;
  Basis basis_{0, 1, 2, 3};
  Matrix inverse_{};
  Row z_{}, y_{};
};

}  // namespace

RadiusSolution maximise_radius(const RadiusProblem& problem) {
  return DualSimplex(problem).solve();
}

}  // namespace strake::geometry
