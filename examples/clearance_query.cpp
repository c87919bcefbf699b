// SPDX-License-Identifier: Apache-2.0
// A loop made parallel: for each pump, the distance to the nearest of its obstacles. Pumps have
// from none to thousands of obstacles, so their costs differ by orders of magnitude.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <vector>

#include "strake/parallel/order.hpp"
#include "strake/parallel/team.hpp"
#include "strake/parallel/transform.hpp"

namespace {

struct Point {
  double x, y, z;
};

struct Pump {
  Point at;
  std::vector<Point> obstacles;
};

double clearance(const Pump& pump) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Point& o : pump.obstacles) {
    const double dx = o.x - pump.at.x, dy = o.y - pump.at.y, dz = o.z - pump.at.z;
    nearest = std::min(nearest, std::sqrt(dx * dx + dy * dy + dz * dz));
  }
  return nearest;
}

std::vector<Pump> make_pumps() {
  std::vector<Pump> pumps(200);
  for (std::size_t i = 0; i < pumps.size(); ++i) {
    const auto k = static_cast<double>(i);
    pumps[i].at = {k, 2 * k, 3 * k};
    const std::size_t count = i % 50 == 7 ? 40'000 : i % 5;
    for (std::size_t j = 1; j <= count; ++j)
      pumps[i].obstacles.push_back({k + 3 * static_cast<double>(j), 2 * k + 4, 3 * k});
  }
  return pumps;
}

}  // namespace

int main() {
  const std::vector<Pump> pumps = make_pumps();

  // Before.
  std::vector<double> expected;
  for (const Pump& pump : pumps) expected.push_back(clearance(pump));

  // After: a slot per item, the heavy items first.
  using namespace strake::parallel;
  Team team(default_workers());
  const auto order =
      longest_first(pumps.size(), [&](std::size_t i) { return pumps[i].obstacles.size(); });
  const auto clearances =
      transform({.team = &team}, {.name = "clearances", .n = pumps.size(), .order = order},
                [&](std::size_t i) { return clearance(pumps[i]); });

  if (!clearances || *clearances != expected) {
    std::puts("the parallel loop gave something else");
    return 1;
  }
  std::printf("%zu clearances; the third is %g\n", clearances->size(), (*clearances)[2]);
  return 0;
}
