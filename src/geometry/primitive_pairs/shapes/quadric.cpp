// SPDX-License-Identifier: Apache-2.0
#include "geometry/primitive_pairs/shapes/quadric.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "geometry/primitive_pairs/shapes/support_mapping.hpp"

namespace strake::geometry::primitive_pairs {
namespace {

constexpr int kMaxSweeps = 12;
/// Off the diagonal less than this, relative, is noise.
constexpr double kClean = 1e-18;
constexpr int kMaxRootSteps = 60;
/// The bound changes with the square of what is left. Relative to how far the multiplier is from
/// 1 / m too: all but in the middle of a body the foot flies off as it comes near.
constexpr double kRootTolerance = 1e-10;
/// The multiplier stays this far under the one at which the surface curves as the ball does.
constexpr double kLastMultiplier = 1 - 1e-10;

using Matrix3 = std::array<std::array<double, 3>, 3>;

void add_square(Matrix3& m, const Vec3d& form, double factor) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      m[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] += factor * form[i] * form[j];
}

/// One rotation of Jacobi's method that makes m[i][j] vanish.
void rotate(Matrix3& m, std::array<Vec3d, 3>& axes, std::size_t i, std::size_t j) {
  if (m[i][j] == 0) return;
  const double theta = (m[j][j] - m[i][i]) / (2 * m[i][j]);
  const double t = (theta < 0 ? -1 : 1) / (std::fabs(theta) + std::sqrt(theta * theta + 1));
  const double c = 1 / std::sqrt(t * t + 1), s = t * c;
  for (std::size_t k = 0; k < 3; ++k) {
    const double a = m[k][i], b = m[k][j];
    m[k][i] = c * a - s * b;
    m[k][j] = s * a + c * b;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const double a = m[i][k], b = m[j][k];
    m[i][k] = c * a - s * b;
    m[j][k] = s * a + c * b;
  }
  m[i][j] = m[j][i] = 0;
  const Vec3d a = axes[i], b = axes[j];
  axes[i] = a * c - b * s;
  axes[j] = a * s + b * c;
}

double off_diagonal(const Matrix3& m) {
  return std::fabs(m[0][1]) + std::fabs(m[0][2]) + std::fabs(m[1][2]);
}

/// The secular equation of a point: q at the stationary point of |y - x|² - multiplier·q(y).
class Secular {
 public:
  Secular(const Quadric& quadric, const Vec3d& x) : q_(quadric), x_(x) {}

  [[nodiscard]] double place(int k, double multiplier) const {
    return (x_[k] + multiplier * q_.b[k]) / (1 - multiplier * q_.m[k]);
  }
  /// q there, and its slope, which is never negative.
  [[nodiscard]] std::pair<double, double> at(double multiplier) const {
    double value = q_.c, slope = 0;
    for (int k = 0; k < 3; ++k) {
      const double y = place(k, multiplier), f = 1 - multiplier * q_.m[k];
      value += (q_.m[k] * y + 2 * q_.b[k]) * y;
      const double g = (q_.m[k] * x_[k] + q_.b[k]) / f;
      slope += 2 * g * g / f;
    }
    return {value, slope};
  }

  [[nodiscard]] double root() const {
    const double least = std::min({q_.m.x, q_.m.y, q_.m.z});
    double lo = least < 0 ? kLastMultiplier / least : -std::numeric_limits<double>::infinity();
    double hi = kLastMultiplier, multiplier = 0;
    for (int step = 0; step < kMaxRootSteps; ++step) {
      const auto [value, slope] = at(multiplier);
      if (value < 0 && step == 0 && at(hi).first <= 0) return hi;
      (value < 0 ? lo : hi) = multiplier;
      double next = multiplier - value / slope;
      if (!(next > lo)) next = std::isfinite(lo) ? (lo + multiplier) / 2 : 2 * multiplier - 1;
      if (!(next < hi)) next = (hi + multiplier) / 2;
      const double moved = std::fabs(next - multiplier);
      multiplier = next;
      if (moved <= kRootTolerance * std::min(std::fabs(multiplier), 1 - multiplier)) break;
    }
    return multiplier;
  }

  /// Any multiplier in [0, 1) gives a lower bound on the squared distance from inside.
  [[nodiscard]] double squared_bound(double multiplier, double reach) const {
    double sum = -multiplier * q_.c, size = std::fabs(sum);
    for (int k = 0; k < 3; ++k) {
      const double b = q_.b[k], f = multiplier / (1 - multiplier * q_.m[k]);
      const double term = (q_.m[k] * x_[k] + 2 * b) * x_[k] + multiplier * b * b;
      sum -= f * term;
      size += f * std::fabs(term);
    }
    return sum - 64 * std::numeric_limits<double>::epsilon() * size - q_.noise * reach * reach;
  }

  /// The stationary point. Where the body's middle is nearest alike in more than one direction the
  /// multiplier has no root, and the surface lies along the axis of the greatest curvature.
  [[nodiscard]] Vec3d foot(double multiplier) const {
    Vec3d y{place(0, multiplier), place(1, multiplier), place(2, multiplier)};
    if (multiplier < 0.999999 * kLastMultiplier) return y;
    const int k = steepest(q_.m);
    double rest = q_.c;
    for (int i = 0; i < 3; ++i)
      if (i != k) rest += (q_.m[i] * y[i] + 2 * q_.b[i]) * y[i];
    const double root = std::sqrt(std::max(0.0, q_.b[k] * q_.b[k] - rest));
    y[k] = (y[k] < 0 ? -root : root) - q_.b[k];
    return y;
  }

  [[nodiscard]] static int steepest(const Vec3d& m) {
    const int first = m.x >= m.y ? 0 : 1;
    return m[first] >= m.z ? first : 2;
  }

 private:
  const Quadric& q_;
  Vec3d x_;
};

}  // namespace

Quadric make_quadric(const Vec3d& centre, const QuadricForms& forms) {
  Matrix3 m{};
  add_square(m, forms.p, 1);
  add_square(m, forms.q, 1);
  add_square(m, forms.r, forms.sign);
  Quadric quadric;
  quadric.centre = centre;
  quadric.axes = {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
  for (int sweep = 0;
       sweep < kMaxSweeps && off_diagonal(m) > kClean * (m[0][0] + m[1][1] + m[2][2]); ++sweep) {
    rotate(m, quadric.axes, 0, 1);
    rotate(m, quadric.axes, 0, 2);
    rotate(m, quadric.axes, 1, 2);
  }
  quadric.m = {m[0][0], m[1][1], m[2][2]};
  const double scale = 1 / std::max({m[0][0], m[1][1], m[2][2]});
  quadric.m = quadric.m * scale;
  const Vec3d linear = forms.r * (forms.sign * forms.s);
  for (int k = 0; k < 3; ++k)
    quadric.b[k] = dot(quadric.axes[static_cast<std::size_t>(k)], linear) * scale;
  quadric.c = (forms.sign * forms.s * forms.s + forms.c) * scale;
  // Where a multiplier may come near 1 / m the terms of its axis must not be differences.
  for (int k = 0; k < 3; ++k) {
    if (quadric.m[k] < 0.5) continue;
    const double b = quadric.b[k], shift = b / quadric.m[k];
    quadric.centre = quadric.centre - quadric.axes[static_cast<std::size_t>(k)] * shift;
    quadric.c -= b * shift;
    quadric.b[k] = 0;
  }
  quadric.noise = forms.noise;
  return quadric;
}

QuadricDepth quadric_depth(const Quadric& quadric, const Vec3d& point, double reach) {
  const Vec3d from = point - quadric.centre;
  const Secular secular(quadric, {dot(quadric.axes[0], from), dot(quadric.axes[1], from),
                                  dot(quadric.axes[2], from)});
  const double multiplier = secular.root();
  const Vec3d y = secular.foot(multiplier);
  QuadricDepth foot;
  Vec3d out, way;
  for (int k = 0; k < 3; ++k) {
    const Vec3d& axis = quadric.axes[static_cast<std::size_t>(k)];
    out = out + axis * (quadric.m[k] * y[k] + quadric.b[k]);
    way = way + axis * y[k];
  }
  const double length = norm(out), away = norm(way - from);
  foot.normal = length > 0 ? out * (1 / length) : quadric.axes[0];
  foot.depth = multiplier > 0 ? away : -away;
  if (multiplier > 0)
    foot.certain = std::sqrt(std::max(0.0, secular.squared_bound(multiplier, reach)));
  return foot;
}

}  // namespace strake::geometry::primitive_pairs
