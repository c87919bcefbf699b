// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/studies/object_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "strake/core/hash.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::cli {

std::vector<geometry::Box3l> object_boxes(const PlacedModel& model, double clearance_mm) {
  const auto margin = static_cast<std::int64_t>(std::ceil(clearance_mm / 2 * geometry::kGridPerMm));
  std::vector<geometry::Box3l> boxes(model.model->objects.size(),
                                     geometry::empty_box<std::int64_t>());
  for (const model::GridBody& body : model.scene.bodies)
    boxes[model::index(body.object)].include(body.box(model.scene.shapes[body.grid_shape]));
  for (geometry::Box3l& box : boxes)
    if (!box.empty()) box = box.inflated(margin);
  return boxes;
}

Computed computed_of(std::vector<geometry::IndexPair> pairs) {
  std::ranges::sort(pairs);
  Hasher hasher;
  for (const geometry::IndexPair& pair : pairs) hasher.add(pair.first).add(pair.second);
  return {{{"pairs", pairs.size()}}, [hash = hasher.value().text()] { return hash; }, {}};
}

}  // namespace strake::cli
