// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "io/gltf/json/json.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/model/model.hpp"

/// Where a file lies on a map, as its importer says.
namespace strake::io {

struct MapPlace {
  std::string crs;  ///< name of the coordinate system of the map, as "EPSG:25832"
  /// From millimetres of the scene with z up to millimetres east, north and up.
  geometry::Placement to_map;
};

/// Returns the place that `{"crs": "EPSG:25832", "matrix": [16 numbers, column by column]}` says;
/// nothing where that is none.
[[nodiscard]] std::optional<MapPlace> map_place_in(const gltf::JsonValue& value);

/// Returns the 16 numbers.
[[nodiscard]] std::array<double, 16> matrix_of(const geometry::Placement& placement);

/// Puts a model where the map has it. Errors: input, where it comes to lie beyond all bounds.
[[nodiscard]] Status put_on_map(const MapPlace& place, model::Model& model);

/// A file, and where it lies, if it says so.
struct FilePlace {
  std::string file;
  std::optional<MapPlace> place;
};

/// Tells of files that do not meet although they should, or that meet only by chance: in
/// coordinates of their own, those of one map that lie there differently; on the map, those of
/// different maps, and those that say nothing of one.
[[nodiscard]] Diagnostics place_diagnostics(const std::vector<FilePlace>& files, bool on_map);

}  // namespace strake::io
