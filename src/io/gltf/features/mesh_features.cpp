// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/features/mesh_features.hpp"

#include <cstddef>
#include <map>
#include <optional>

#include "io/gltf/features/property_tables.hpp"

namespace strake::io::gltf {

MeshFeatures features_of(const JsonValue& mesh, const Accessors& accessors, std::uint64_t& left) {
  std::map<std::uint64_t, std::uint64_t> row_of_table;
  MeshFeatures found;
  mesh["primitives"].elements([&](const JsonValue& primitive) {
    const auto [attributes, extensions] = primitive.pick<2>({"attributes", "extensions"});
    const JsonValue extension = extensions["EXT_mesh_features"];
    if (!extension.exists()) return;
    for (const FeatureIds& set : read_feature_ids(extension, attributes, accessors)) {
      // Without ids each vertex is a feature of its own.
      if (!set.ids || set.ids->count > left) found.several = true;
      if (!found.several) left -= set.ids->count;
      for (std::size_t vertex = 0; !found.several && vertex < set.ids->count; ++vertex) {
        const std::optional<std::uint64_t> row = set.of(vertex);
        if (row) found.several = row_of_table.try_emplace(set.table, *row).first->second != *row;
      }
    }
  });
  if (!found.several) found.rows.assign(row_of_table.begin(), row_of_table.end());
  return found;
}

}  // namespace strake::io::gltf
