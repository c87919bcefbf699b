// SPDX-License-Identifier: Apache-2.0
#include "geometry/depth/radius_simplex.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace strake::geometry {
namespace {

using Row = std::array<double, 4>;
using Matrix = std::array<Row, 4>;

constexpr double kPivot = 1e-11;
constexpr double kEps = std::numeric_limits<double>::epsilon();

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

/// A sum of constraints, none times less than nothing.
struct Combination {
  Row row{};
  double bound = 0;
  double magnitude = 0, weight = 0;  ///< of what was added

  void add(const RadiusConstraint& c, double times) {
    const Row a = row_of(c);
    for (std::size_t k = 0; k < 4; ++k) row[k] += times * a[k];
    bound += times * c.offset;
    magnitude += times * std::fabs(c.offset);
    weight += times;
  }
  /// The most that the row gives for any point in the extent.
  [[nodiscard]] double reach(double extent) const {
    double most = 0;
    for (const double v : row) most += std::fabs(v);
    return most * extent * (1 + 16 * kEps);
  }
  /// What rounding may have changed.
  [[nodiscard]] double error(double extent) const {
    return 16 * kEps * (magnitude + weight * extent);
  }
};

}  // namespace

RadiusSimplex::RadiusSimplex(std::span<const RadiusConstraint, 4> first, double extent)
    : extent_(extent) {
  std::copy(first.begin(), first.end(), rows_.begin());
}

bool RadiusSimplex::load() {
  Matrix m;
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
double RadiusSimplex::proven_upper() const {
  Combination sum{.row = {0, 0, 0, -1}};
  for (std::size_t i = 0; i < 4; ++i) sum.add(rows_[i], std::max(y_[i], 0.0));
  return sum.bound + sum.reach(extent_) + sum.error(extent_) + 16 * kEps * extent_;
}

bool RadiusSimplex::holds(std::size_t id) const {
  return std::find(ids_.begin(), ids_.end(), id) != ids_.end();
}

/// How much of the i-th row is in another one.
double RadiusSimplex::share(const RadiusConstraint& c, std::size_t i) const {
  const Row a = row_of(c);
  double w = 0;
  for (std::size_t k = 0; k < 4; ++k) w += a[k] * inverse_[k][i];
  return w;
}

double RadiusSimplex::doubt(const RadiusConstraint& c) const {
  double most = 0;
  for (std::size_t i = 0; i < 4; ++i)
    most += std::fabs(share(c, i)) *
            (std::fabs(excess(rows_[i])) + kEps * (std::fabs(rows_[i].offset) + extent_));
  return most;
}

/// With a the entering row and rest = a + sum w a_i, all z that satisfy the five constraints have
/// rest·z <= b + sum w b_i: none has where that is less than rest can be for any z in the extent.
bool RadiusSimplex::proves_empty(const RadiusConstraint& entering) const {
  Combination sum;
  sum.add(entering, 1);
  for (std::size_t i = 0; i < 4; ++i) sum.add(rows_[i], std::max(-share(entering, i), 0.0));
  return sum.bound < -(sum.reach(extent_) + sum.error(extent_));
}

bool RadiusSimplex::exchange(const RadiusConstraint& entering, std::size_t id) {
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

}  // namespace strake::geometry
