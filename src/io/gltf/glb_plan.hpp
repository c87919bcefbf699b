// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "io/source/units_and_axes.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/mesh.hpp"
#include "strake/io/writer.hpp"
#include "strake/model/model.hpp"

namespace strake::io::gltf {

/// Geometry that is stored in the binary chunk once: a shape, in the frame of the mesh that has it.
struct StoredGeometry {
  const geometry::TriangleMesh* mesh = nullptr;  ///< one of these two
  const geometry::Polylines* lines = nullptr;
  geometry::Placement relative;  ///< from shape frame to mesh frame; identity for most
  std::uint64_t first_vertex = 0;
  std::uint64_t vertex_count = 0;
  std::uint64_t first_index = 0;  ///< among the indices of its width
  std::uint64_t index_count = 0;
  bool wide = false;                ///< 32-bit indices; otherwise 16
  std::array<float, 3> lo{}, hi{};  ///< the bounds of the coordinates as written

  [[nodiscard]] const std::vector<geometry::Vec3d>& vertices() const {
    return mesh != nullptr ? mesh->vertices : lines->points;
  }
};

struct MeshPrimitive {
  std::uint32_t piece = 0;
  std::uint32_t material = 0;
  friend auto operator<=>(const MeshPrimitive&, const MeshPrimitive&) = default;
};

inline constexpr std::uint32_t kNoMesh = 0xffffffffU;

/// The glTF document that a model becomes, before a byte is written.
struct GlbPlan {
  SourceFrame frame;  ///< the frame of the file
  std::vector<StoredGeometry> pieces;
  std::vector<std::vector<MeshPrimitive>> meshes;
  std::vector<model::Color> materials;
  struct ObjectNode {
    std::uint32_t mesh = kNoMesh;
    geometry::Placement placement;  ///< in the model's frame
  };
  std::vector<ObjectNode> objects;  ///< per object of the model
  std::uint64_t vertex_count = 0, wide_count = 0, narrow_count = 0;
  std::deque<geometry::TriangleMesh> made;  ///< the triangles of analytic primitives
  std::deque<geometry::Polylines> made_lines;

  /// Returns a vertex of a piece as it is written.
  [[nodiscard]] std::array<float, 3> written(const StoredGeometry& piece,
                                             const geometry::Vec3d& v) const;
};

[[nodiscard]] Result<GlbPlan> plan_glb(const model::Model& model, const WriteOptions& options);

}  // namespace strake::io::gltf
