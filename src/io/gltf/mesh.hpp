// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "io/gltf/accessor.hpp"
#include "io/gltf/json/json.hpp"
#include "io/source/units_and_axes.hpp"
#include "strake/geometry/mesh.hpp"
#include "strake/model/model.hpp"

namespace strake::io::gltf {

/// A mesh of the document as shapes: its opaque primitives are one, whatever their materials,
/// because a solid cut along its colours would be no solid; so are its transparent ones, but for
/// those that a solid does not close without (merge_transparent_shells).
struct LoadedMesh {
  geometry::TriangleMesh opaque, transparent;  ///< mm, z up
  geometry::Polylines lines;
  model::Color opaque_color, transparent_color,
      line_color;            ///< the colours of most triangles or segments
  double step = 0;           ///< spacing of quantised coordinates in file units; 0: float32
  std::uint32_t points = 0;  ///< primitives that are point clouds
  std::uint32_t odd = 0;     ///< primitives with indices left over behind the last triangle or line
  bool part_transparent = false;  ///< some transparent faces are among the opaque
  /// Triangles and segments with a vertex that has no position or does not exist; they are left
  /// out.
  std::uint64_t faces_left_out = 0, lines_left_out = 0;
  std::optional<GltfFault> first_left_out;  ///< why, of the first such vertex
  std::optional<GltfFault> fault;           ///< if set, the mesh is not to be used
};

struct MeshInput {
  const Accessors* accessors = nullptr;
  const std::vector<model::Color>* materials = nullptr;
  SourceFrame frame;
};

[[nodiscard]] LoadedMesh load_mesh(const MeshInput& input, const JsonValue& mesh,
                                   std::size_t index);

/// Returns how many corners loading the mesh would put into memory, as the file states them.
[[nodiscard]] std::uint64_t stated_corners(const Accessors& accessors, const JsonValue& mesh);

/// Returns the colours of all materials of a document.
[[nodiscard]] std::vector<model::Color> material_colors(const JsonValue& root);

}  // namespace strake::io::gltf
