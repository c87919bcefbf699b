// SPDX-License-Identifier: Apache-2.0
#include "project/views/object_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "strake/geometry/grid.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::project {

Result<std::vector<geometry::Box3l>> object_boxes(const model::Scene& scene,
                                                  const parallel::Context& context) {
  // Meshes are coarser than the true surface by their sag at most, or where that would take more
  // segments than are made by less than a part in 65,536 of their size; and they are rounded to
  // the grid.
  constexpr std::int64_t kRounding = 2, kPartOfSize = 65536;
  const auto sag = static_cast<std::int64_t>(std::ceil(scene.sag_mm * geometry::kGridPerMm));
  return parallel::transform(
      context, {.name = "boxes of objects", .n = scene.model->objects.size(), .grain = 1024},
      [&](std::size_t object) {
        geometry::Box3l box = geometry::empty_box<std::int64_t>();
        const auto id = model::ObjectId{static_cast<std::uint32_t>(object)};
        for (const model::GridBody& body : scene.bodies_of(id))
          box.include(body.box(scene.shapes[body.grid_shape]));
        if (box.empty()) return box;
        const geometry::Vec3l size = box.hi - box.lo;
        return box.inflated(sag + kRounding + std::max({size.x, size.y, size.z}) / kPartOfSize);
      });
}

}  // namespace strake::project
