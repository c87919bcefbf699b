// SPDX-License-Identifier: Apache-2.0
#include "geometry/numeric/trig.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace strake::geometry {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kHalfPi = 0x1.921fb54442d18p+0, kHalfPiRest = 0x1.1a62633145c07p-54;

/// pi/2 in pieces of 33 bits and a rest: products with integers below 2^20 are exact
/// (W. J. Cody and W. Waite, Software Manual for the Elementary Functions, 1980).
constexpr double kPiece1 = 0x1.921fb54400000p+0, kPiece2 = 0x1.0b4611a600000p-34,
                 kPiece3 = 0x1.3198a2e037073p-69;

/// Taylor series; on |r| <= pi/4 the first term left out is below 10^-19.
SinCos series(double r) {
  const double q = r * r;
  double s = 1.0 / 355687428096000.0;  // 1/17!
  for (const double f : {-1.0 / 1307674368000.0, 1.0 / 6227020800.0, -1.0 / 39916800.0,
                         1.0 / 362880.0, -1.0 / 5040.0, 1.0 / 120.0, -1.0 / 6.0})
    s = s * q + f;
  double c = -1.0 / 6402373705728000.0;  // 1/18!
  for (const double f : {1.0 / 20922789888000.0, -1.0 / 87178291200.0, 1.0 / 479001600.0,
                         -1.0 / 3628800.0, 1.0 / 40320.0, -1.0 / 720.0, 1.0 / 24.0})
    c = c * q + f;
  // 1 - q/2 is rounded once; what the rounding lost is added back with the small terms.
  const double half = q / 2, rough = 1 - half;
  return {r + r * (q * s), rough + (((1 - rough) - half) + q * q * c)};
}

/// arc tangents of k/8, in two pieces.
constexpr std::array<double, 9> kAtan{0x0.0p+0,
                                      0x1.fd5ba9aac2f6ep-4,
                                      0x1.f5b75f92c80ddp-3,
                                      0x1.6f61941e4def1p-2,
                                      0x1.dac670561bb4fp-2,
                                      0x1.1e00babdefeb4p-1,
                                      0x1.4978fa3269ee1p-1,
                                      0x1.700a7c5784634p-1,
                                      0x1.921fb54442d18p-1};
constexpr std::array<double, 9> kAtanRest{0x0.0p+0,
                                          -0x1.cd37686760c17p-59,
                                          0x1.8ab6e3cf7afbdp-57,
                                          -0x1.c63aae6f6e918p-56,
                                          0x1.a2b7f222f65e2p-56,
                                          -0x1.928df287a668fp-58,
                                          0x1.2419a87f2a458p-56,
                                          -0x1.8c34d25aadef6p-56,
                                          0x1.1a62633145c07p-55};

/// Arc tangent of y/x for 0 <= y <= x, x > 0.
double atan_ratio(double y, double x) {
  const auto k = static_cast<std::size_t>(y / x * 8 + 0.5);
  const double node = static_cast<double>(k) / 8;
  // atan(y/x) = atan(node) + atan(t); |t| <= 1/16: the first term left out is below 10^-19.
  const double t = (y - node * x) / (x + node * y);
  const double q = t * t;
  double p = -1.0 / 15;
  for (const double f : {1.0 / 13, -1.0 / 11, 1.0 / 9, -1.0 / 7, 1.0 / 5, -1.0 / 3}) p = p * q + f;
  return kAtan[k] + (t + (t * (q * p) + kAtanRest[k]));
}

}  // namespace

SinCos sin_cos(double angle) {
  if (!(std::fabs(angle) <= 1e6)) return {kNan, kNan};
  const double turns = angle / kHalfPi;
  const auto quarter = static_cast<std::int64_t>(turns + (turns < 0 ? -0.5 : 0.5));
  const auto n = static_cast<double>(quarter);
  const SinCos sc = series(((angle - n * kPiece1) - n * kPiece2) - n * kPiece3);
  switch (quarter & 3) {
    case 0:
      return sc;
    case 1:
      return {sc.cos, -sc.sin};
    case 2:
      return {-sc.sin, -sc.cos};
    default:
      return {-sc.cos, sc.sin};
  }
}

double arc_tan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return kNan;
  double ax = std::fabs(x), ay = std::fabs(y);
  if (ax == 0 && ay == 0) return 0;
  if (std::isinf(ax) || std::isinf(ay)) {
    ax = std::isinf(ax) ? 1 : 0;
    ay = std::isinf(ay) ? 1 : 0;
  }
  double angle = ay <= ax ? atan_ratio(ay, ax) : kHalfPi - (atan_ratio(ax, ay) - kHalfPiRest);
  if (x < 0) angle = kPi - (angle - 2 * kHalfPiRest);
  return y < 0 ? -angle : angle;
}

double arc_cos(double x) {
  if (!(std::fabs(x) <= 1)) return kNan;
  return 2 * arc_tan2(std::sqrt(1 - x), std::sqrt(1 + x));
}

double arc_sin(double x) {
  if (!(std::fabs(x) <= 1)) return kNan;
  return arc_tan2(x, std::sqrt((1 - x) * (1 + x)));
}

std::vector<SinCos> unit_circle(int n) {
  std::vector<SinCos> points(static_cast<std::size_t>(std::max(n, 0)));
  const auto at = [&](int k) -> SinCos& { return points[static_cast<std::size_t>(k)]; };
  if (n % 4 != 0) {
    for (int k = 0; k < n; ++k) at(k) = sin_cos(2 * kPi * k / n);
    return points;
  }
  const int quarter = n / 4;
  for (int k = 0; k <= quarter / 2; ++k) {
    const SinCos sc = sin_cos(2 * kPi * k / n);
    at(k) = sc;
    if (k < quarter) at(quarter - k) = {sc.cos, sc.sin};
  }
  if (quarter > 0) at(0) = {0, 1};
  if (quarter > 0 && quarter % 2 == 0) at(quarter / 2) = {std::sqrt(0.5), std::sqrt(0.5)};
  for (int k = 0; k < quarter; ++k) {
    const SinCos sc = at(k);
    at(k + quarter) = {sc.cos, -sc.sin};
    at(k + 2 * quarter) = {-sc.sin, -sc.cos};
    at(k + 3 * quarter) = {-sc.cos, sc.sin};
  }
  return points;
}

double sagitta(double radius, double angle) {
  const double s = sin_cos(angle / 4).sin;  // 1 - cos(x) = 2 sin²(x/2), without cancellation
  return radius * 2 * s * s;
}

int arc_segments(double radius, double angle, double sag, int limit) {
  const double share = sag / radius;
  if (!(angle > 0) || !(share < 2)) return 1;
  // The widest angle whose sagitta is the sag: 4·asin(sqrt(share / 2)).
  const double widest = share > 0 ? 4 * arc_sin(std::sqrt(share / 2)) : 0;
  if (!(widest * limit > angle)) return limit;
  auto n = static_cast<int>(angle / widest);
  n = std::max(n, 1);
  while (n < limit && sagitta(radius, angle / n) > sag) ++n;
  return n;
}

int circle_segments(double radius, double sag, int limit) {
  const int n = arc_segments(radius, 2 * kPi, sag, limit);
  return std::clamp((n + 3) / 4 * 4, 8, limit);
}

}  // namespace strake::geometry
