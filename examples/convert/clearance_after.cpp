// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "clearance.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/order.hpp"
#include "strake/parallel/shape2.hpp"
#include "strake/parallel/transform.hpp"
#include "triangle_distance.hpp"

namespace convert::after {

using namespace strake::parallel;

namespace {

double distance(const Part& part, const Valve& valve, std::vector<Offset>& offsets) {
  offsets.clear();
  for (const Point& p : part.points)
    offsets.push_back({static_cast<double>(p.x - valve.at.x), static_cast<double>(p.y - valve.at.y),
                       static_cast<double>(p.z - valve.at.z)});
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : part.triangles)
    nearest = std::min(nearest, squared_distance(offsets[a], offsets[b], offsets[c]));
  return std::sqrt(nearest);
}

}  // namespace

strake::Result<Clearances> clearances(const Model& model, const std::vector<Box>& boxes,
                                      const std::vector<Valve>& valves, const Context& context) {
  const Shape2 shape{static_cast<std::uint32_t>(valves.size()),
                     static_cast<std::uint32_t>(model.size())};
  const Region tests{.name = "box tests", .n = shape.size(), .grain = 4096};
  const auto near = collect<Shape2::Index>(context, tests,
                                           [&](std::size_t flat, std::vector<Shape2::Index>& out) {
                                             const auto [v, p] = shape.index(flat);
                                             if (comes_near(boxes[p], valves[v]))
                                               out.push_back({v, p});
                                           });
  if (!near) return near.error();
  const auto size = [&](std::size_t k) { return model[(*near)[k].column].triangles.size(); };
  const auto order = longest_first(near->size(), size);
  const auto distances = transform_with(
      context, {.name = "distances", .n = near->size(), .order = order},
      [] { return std::vector<Offset>(); },
      [&](std::vector<Offset>& offsets, std::size_t k) {
        return distance(model[(*near)[k].column], valves[(*near)[k].row], offsets);
      });
  if (!distances) return distances.error();
  Clearances found;
  for (std::size_t k = 0; k < near->size(); ++k) {
    const auto [v, p] = (*near)[k];
    const double d = (*distances)[k];
    if (d < valves[v].clearance) found.too_near.push_back({v, p, d});
    found.triangles_tested += size(k);
  }
  return found;
}

}  // namespace convert::after
