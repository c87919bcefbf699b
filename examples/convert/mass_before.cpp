// SPDX-License-Identifier: Apache-2.0
#include "mass.hpp"

namespace convert::before {
namespace {

// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables): what the conversion removes
Sums sums;
Masses result;
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

void add_triangles(const Part& part) {
  for (const auto& [a, b, c] : part.triangles)
    sums.add(part.points[a], part.points[b], part.points[c]);
}

void add_part(std::uint32_t part) {
  result.of_part.push_back(sums);
  if (sums.is_closed())
    result.total.add(sums);
  else
    result.open.push_back(part);
}

}  // namespace

Masses masses(const Model& model) {
  result = {};
  for (std::uint32_t part = 0; part < model.size(); ++part) {
    sums = {};
    add_triangles(model[part]);
    add_part(part);
  }
  return result;
}

}  // namespace convert::before
