// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <variant>
#include <vector>

#include "page/geometry/page_mesh.hpp"
#include "page/geometry/shown_objects.hpp"
#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::page {

/// One shape of an object, placed: rows of a 3x4 matrix in millimetres from the page's origin.
struct PageInstance {
  std::uint32_t shape = 0, object = 0;  ///< the object by its number in the model
  std::uint32_t colour = 0;             ///< 0xRRGGBB
  std::array<float, 12> matrix{};
};

/// The shapes of a page, each once, and where they stand.
struct PageShapes {
  std::vector<PageMesh> meshes;
  std::vector<PageInstance> instances;  ///< by object
};

/// Collects the shapes of the objects that are shown as they are. Errors: cancelled, out of memory.
[[nodiscard]] Result<PageShapes> page_shapes(const model::Scene& scene, const ShownObjects& shown,
                                             const geometry::Vec3d& origin_mm,
                                             const parallel::Context& context);

}  // namespace strake::page
