// SPDX-License-Identifier: Apache-2.0
#include "pictures/scenery/scene_index.hpp"

#include <algorithm>

#include "strake/parallel/transform.hpp"

namespace strake::pictures {

using geometry::Box3l;
using geometry::SceneBvh;

Result<SceneIndex> SceneIndex::of(const model::Scene& scene, const parallel::Context& context) {
  constexpr std::size_t kBodiesPerBlock = 4096;
  const auto items = parallel::transform(
      context, {.name = "boxes of bodies", .n = scene.bodies.size(), .grain = kBodiesPerBlock},
      [&](std::size_t b) {
        const model::GridBody& body = scene.bodies[b];
        const model::GridShape& shape = scene.shapes[body.grid_shape];
        return geometry::BoxItem{
            shape.box.empty() ? geometry::empty_box<std::int64_t>() : body.box(shape),
            static_cast<std::uint32_t>(b)};
      });
  if (!items) return items.error();
  Result<SceneBvh> tree = SceneBvh::build(*items, context);
  if (!tree) return tree.error();
  return SceneIndex(std::move(*tree));
}

std::vector<std::uint32_t> SceneIndex::bodies_in(const Box3l& box) const {
  std::vector<std::uint32_t> found, open;
  if (!tree_.nodes().empty()) open.push_back(0);
  while (!open.empty()) {
    const SceneBvh::Node& node = tree_.nodes()[open.back()];
    open.pop_back();
    if (!tree_.box(node).meets(box)) continue;
    if (node.count == 0) {
      open.push_back(node.first);
      open.push_back(node.first + 1);
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      if (const Box3l& own = tree_.items()[i].box; !own.empty() && own.meets(box))
        found.push_back(tree_.order()[i]);
  }
  std::ranges::sort(found);
  return found;
}

}  // namespace strake::pictures
