// SPDX-License-Identifier: Apache-2.0
// docs/patterns/convert.md, the second conversion: the free space round valves, by the sequential
// program and by teams.
#include "clearance.hpp"

#include <cstdio>

#include "everywhere.hpp"

namespace {

using namespace convert;

strake::Result<Clearances> clearances(const Model& model, const std::vector<Valve>& valves,
                                      const strake::parallel::Context& context) {
  const auto boxes = after::boxes_of(model, context);
  if (!boxes) return boxes.error();
  return after::clearances(model, *boxes, valves, context);
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
  const auto run = [&](const strake::parallel::Context& context) {
    return clearances(model, valves, context);
  };
  if (!same_everywhere(expected, run)) return 1;
  std::puts("the same bytes from 1, 2, 3, 8 and 64 workers");
  return 0;
}
