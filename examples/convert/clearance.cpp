// SPDX-License-Identifier: Apache-2.0
// docs/patterns/convert.md, the second conversion: the free space round valves, by the sequential
// program and by teams.
#include "clearance.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "everywhere.hpp"

namespace {

using namespace convert;

strake::Result<Clearances> clearances(const Model& model, const std::vector<Valve>& valves,
                                      const strake::parallel::Context& context) {
  const auto boxes = after::boxes_of(model, context);
  if (!boxes) return boxes.error();
  return after::clearances(model, *boxes, valves, context);
}

/// Whether a distance is that to the part, as far as its points can tell: none is nearer, and the
/// nearest is no further off than the longest edge that a small part or a giant has.
bool fits_points(const Model& model, const std::vector<Valve>& valves, const TooNear& one) {
  constexpr double kLongestEdge = 200;
  const Point& at = valves[one.valve].at;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Point& p : model[one.part].points)
    nearest = std::min(nearest, std::hypot(p.x - at.x, p.y - at.y, p.z - at.z));
  return one.distance <= nearest && one.distance >= nearest - kLongestEdge;
}

}  // namespace

int main() {
  const Model model = make_model(3000, 60);
  const std::vector<Valve> valves = make_valves(100);
  const Clearances expected = before::clearances(model, valves);
  std::printf("%zu valves, %zu parts, %llu triangles tested, %zu parts too near\n", valves.size(),
              model.size(), static_cast<unsigned long long>(expected.triangles_tested),
              expected.too_near.size());
  for (std::size_t k = 0; k < expected.too_near.size(); k += 5) {
    const TooNear& one = expected.too_near[k];
    std::printf("  valve %u: part %u at %.3f mm, needs %d\n", one.valve, one.part, one.distance,
                valves[one.valve].clearance);
  }
  if (expected.too_near.empty()) return 1;
  for (const TooNear& one : expected.too_near)
    if (!fits_points(model, valves, one)) return 1;
  const auto run = [&](const strake::parallel::Context& context) {
    return clearances(model, valves, context);
  };
  if (!same_everywhere(expected, run)) return 1;
  std::puts("the same bytes from 1, 2, 3, 8 and 64 workers");
  return 0;
}
