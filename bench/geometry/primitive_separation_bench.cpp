// SPDX-License-Identifier: Apache-2.0
// What a pair of analytic primitives costs by kind: CPU nanoseconds beside each other at 10 mm, out
// of reach, and meeting. A case whose bracket does not hold the distance that the pair was placed
// at reports an error instead of a time.
#include <fmt/core.h>

#include <cmath>
#include <ctime>
#include <string>
#include <vector>

#include "strake/geometry/primitive_separation.hpp"

namespace {

using namespace strake::geometry;

struct Kind {
  Primitive primitive;
  double reach = 0;  ///< along its z axis, mm
  Vec3d middle;      ///< where it reaches that far
};

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Repeats until a fifth of a second is spent; nanoseconds a call.
template <class Call>
double nanoseconds(Call&& call) {
  for (long n = 1;; n *= 2) {
    const double start = cpu_seconds();
    for (long i = 0; i < n; ++i) call();
    const double seconds = cpu_seconds() - start;
    if (seconds > 0.2) return seconds / static_cast<double>(n) * 1e9;
  }
}

/// b above a in a turned frame.
void bench_pair(const Kind& a, const Kind& b) {
  const Mat3d turn{{Vec3d{-2.0 / 3, 2.0 / 15, 11.0 / 15}, Vec3d{2.0 / 3, -1.0 / 3, 2.0 / 3},
                    Vec3d{1.0 / 3, 14.0 / 15, 2.0 / 15}}};
  const auto at = [&](double gap) {
    return Placement{turn, turn * (a.middle - b.middle + Vec3d{0, 0, a.reach + b.reach + gap})};
  };
  const Placement here{turn, {}};
  const std::string name =
      std::string(kind_name(a.primitive)) + " and " + std::string(kind_name(b.primitive));
  const auto run = [&](double gap, double cutoff) {
    const Placement there = at(gap);
    return iterative_separation({&a.primitive, &here}, {&b.primitive, &there}, cutoff);
  };
  const double far = 1e300;
  const auto beside = run(10, far), meeting = run(-5, far), away = run(200, 1000);
  const bool right = beside && meeting && away &&
                     std::fabs(beside->d - 10'000) <= beside->error() + 2 && meeting->d < 0 &&
                     meeting->d <= -5'000 + meeting->error() + 2 && away->d >= 1000;
  if (!right) {
    fmt::print("{:<44}  ERROR: wrong result\n", name);
    return;
  }
  fmt::print("{:<44}{:>10.0f} beside{:>10.0f} out of reach{:>12.0f} meeting\n", name,
             nanoseconds([&] { (void)run(10, far); }), nanoseconds([&] { (void)run(200, 1000); }),
             nanoseconds([&] { (void)run(-5, far); }));
}

std::vector<Kind> kinds() {
  const double half = 150 * std::sqrt(0.5);
  SnoutPrimitive snout;
  snout.bottom_radius = 90;
  snout.top_radius = 60;
  snout.height = 200;
  snout.offset_x = 40;
  return {{BoxPrimitive{300, 200, 100}, 50, {}},
          {PyramidPrimitive{200, 200, 80, 60, 30, 0, 150}, 75, {15, 0, 0}},
          {CylinderPrimitive{80, 300}, 150, {}},
          {snout, 100, {20, 0, 0}},
          {SpherePrimitive{200}, 100, {}},
          {CircularTorusPrimitive{150, 50, 1.5707963267948966}, 50, {half, half, 0}},
          {RectangularTorusPrimitive{100, 200, 80, 1.5707963267948966}, 40, {half, half, 0}}};
}

}  // namespace

int main() {
  const std::vector<Kind> all = kinds();
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i; j < all.size(); ++j) bench_pair(all[i], all[j]);
  return 0;
}
