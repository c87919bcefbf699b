// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/features/mesh_features.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include "io/gltf/features/property_tables.hpp"

namespace strake::io::gltf {

namespace {

/// The row that all vertices name by a set; `several` if they name different ones.
struct SetRow {
  std::optional<std::uint64_t> row;
  bool several = false;
};

void find_common_row(const FeatureIds& set, std::uint64_t& left, SetRow& found) {
  // Without ids each vertex is a feature of its own.
  if (!set.ids || set.ids->count > left) found.several = true;
  if (!found.several) left -= set.ids->count;
  for (std::size_t vertex = 0; !found.several && vertex < set.ids->count; ++vertex) {
    const std::optional<std::uint64_t> row = set.of(vertex);
    if (!row) continue;
    if (!found.row) found.row = row;
    found.several = found.row != row;
  }
}

}  // namespace

MeshFeatures features_of(const JsonValue& mesh, const Accessors& accessors, std::uint64_t& left) {
  // Sets in one place, of one table, of several primitives are one set: they tell of the same kind
  // of feature, as the storey that a part is in, and those in another place of another.
  std::map<std::pair<std::size_t, std::uint64_t>, SetRow> sets;
  mesh["primitives"].elements([&](const JsonValue& primitive) {
    const auto [attributes, extensions] = primitive.pick<2>({"attributes", "extensions"});
    const JsonValue extension = extensions["EXT_mesh_features"];
    if (!extension.exists()) return;
    for (const FeatureIds& set : read_feature_ids(extension, attributes, accessors))
      find_common_row(set, left, sets[{set.place, set.table}]);
  });
  MeshFeatures found;
  for (const auto& [set, one] : sets) {
    found.several = found.several || one.several;
    if (!one.row || one.several) continue;
    const std::pair row(set.second, *one.row);
    if (std::ranges::find(found.rows, row) == found.rows.end()) found.rows.push_back(row);
  }
  return found;
}

}  // namespace strake::io::gltf
