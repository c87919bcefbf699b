// SPDX-License-Identifier: Apache-2.0
#include "project/views/object_boxes.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "strake/geometry/grid.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::project {

Result<std::vector<geometry::Box3l>> object_boxes(const model::Scene& scene,
                                                  const parallel::Context& context) {
  // Meshes are coarser than the true surface by their sag at most, and are rounded to the grid.
  constexpr std::int64_t kRounding = 2;
  const auto sag = static_cast<std::int64_t>(std::ceil(scene.sag_mm * geometry::kGridPerMm));
  return parallel::transform(
      context, {.name = "boxes of objects", .n = scene.model->objects.size(), .grain = 1024},
      [&](std::size_t object) {
        geometry::Box3l box = geometry::empty_box<std::int64_t>();
        const auto id = model::ObjectId{static_cast<std::uint32_t>(object)};
        for (const model::GridBody& body : scene.bodies_of(id))
          box.include(body.box(scene.shapes[body.grid_shape]));
        return box.empty() ? box : box.inflated(sag + kRounding);
      });
}

}  // namespace strake::project
