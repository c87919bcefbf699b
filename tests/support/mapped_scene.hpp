// SPDX-License-Identifier: Apache-2.0
// A scene made anew with every vertex elsewhere.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "strake/model/scene.hpp"
#include "support/scene_builder.hpp"

namespace strake::test {

/// Every part moved by a map of the grid, triangles in another order; a map that mirrors turns them
/// round. `each_apart`: every body becomes an object of its own.
template <class Map>
SceneBuilder mapped(const model::Scene& scene, const Map& map, bool mirrors = false,
                    bool each_apart = false) {
  SceneBuilder result;
  for (std::uint32_t object = 0; object < scene.model->objects.size(); ++object) {
    std::vector<HandBody> bodies;
    for (const model::GridBody& body : scene.bodies_of(model::ObjectId{object})) {
      HandBody hand{.parts = {}, .origin = {}, .alpha = scene.model->bodies[body.body].color.alpha};
      const auto moved = [&](const geometry::Vec3i& v) {
        return map(v.as<std::int64_t>() + body.origin).template as<std::int32_t>();
      };
      for (const geometry::Part& part : scene.shapes[body.grid_shape].parts) {
        HandPart one{{}, part.triangles.to_vector(), part.faces.to_vector(), {}};
        for (std::size_t c = 0; c + 1 < part.chain_first.size(); ++c) {
          one.chains.emplace_back();
          for (std::uint32_t v = part.chain_first[c]; v < part.chain_first[c + 1]; ++v)
            one.chains.back().push_back(moved(part.vertices[v]));
        }
        if (one.chains.empty())
          for (const geometry::Vec3i& v : part.vertices) one.vertices.push_back(moved(v));
        std::ranges::reverse(one.triangles);
        std::ranges::reverse(one.faces);
        if (mirrors)
          for (geometry::Triangle& t : one.triangles) std::swap(t[1], t[2]);
        hand.parts.push_back(one);
      }
      bodies.push_back(hand);
      if (each_apart) result.object(std::exchange(bodies, {}));
    }
    if (!each_apart) result.object(bodies);
  }
  return result;
}

}  // namespace strake::test
