// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "clearance.hpp"
#include "triangle_distance.hpp"

namespace convert::before {
namespace {

// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables): what the conversion removes
std::vector<Offset> offsets;  // scratch, so that it is not allocated for each part
Clearances found;
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

double distance(const Part& part, const Valve& valve) {
  offsets.clear();
  for (const Point& p : part.points)
    offsets.push_back({static_cast<double>(p.x - valve.at.x), static_cast<double>(p.y - valve.at.y),
                       static_cast<double>(p.z - valve.at.z)});
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : part.triangles)
    nearest = std::min(nearest, squared_distance(offsets[a], offsets[b], offsets[c]));
  found.triangles_tested += part.triangles.size();
  return std::sqrt(nearest);
}

}  // namespace

Clearances clearances(const Model& model, const std::vector<Valve>& valves) {
  found = {};
  for (std::uint32_t v = 0; v < valves.size(); ++v)
    for (std::uint32_t p = 0; p < model.size(); ++p) {
      if (!comes_near(box_of(model, p), valves[v])) continue;
      const double d = distance(model[p], valves[v]);
      if (d < valves[v].clearance) found.too_near.push_back({v, p, d});
    }
  return found;
}

}  // namespace convert::before
