// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
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
  double sag_mm = -1;            ///< of the triangles in the mesh frame; negative: not stated
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

/// Blocks begin at multiples of so many bytes, as doubles need it.
inline constexpr std::uint64_t kBlockAlignment = 8;

[[nodiscard]] constexpr std::uint64_t padded(std::uint64_t bytes, std::uint64_t alignment) {
  return (bytes + alignment - 1) / alignment * alignment;
}

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
  std::vector<std::string> mesh_extras;            ///< JSON, per mesh; empty where it has none
  std::vector<std::span<const std::byte>> blocks;  ///< what else the binary chunk holds
  std::deque<geometry::TriangleMesh> made;         ///< the triangles of analytic primitives
  std::deque<geometry::Polylines> made_lines;

  /// Returns the bytes of positions and indices.
  [[nodiscard]] std::uint64_t core_bytes() const {
    return 12 * vertex_count + 4 * wide_count + 2 * narrow_count;
  }
  /// Returns how many buffer views there are before those of the blocks.
  [[nodiscard]] std::uint32_t core_views() const {
    return 1U + (wide_count != 0 ? 1U : 0U) + (narrow_count != 0 ? 1U : 0U);
  }
  /// Returns where the first block begins; what core_bytes() says is padded for it.
  [[nodiscard]] std::uint64_t blocks_begin() const {
    return padded(core_bytes(), blocks.empty() ? 4 : kBlockAlignment);
  }
  [[nodiscard]] std::uint64_t binary_bytes() const {
    std::uint64_t bytes = blocks_begin();
    for (const std::span<const std::byte> block : blocks)
      bytes += padded(block.size(), kBlockAlignment);
    return bytes;
  }
  /// Finds the bounds of a piece as it is written. Errors: output, where one is not finite.
  [[nodiscard]] Status measure(StoredGeometry& piece) const;
  /// Adds a measured piece, and says where its vertices and indices are.
  void append(StoredGeometry piece);
  /// Returns a vertex of a piece as it is written.
  [[nodiscard]] std::array<float, 3> written(const StoredGeometry& piece,
                                             const geometry::Vec3d& v) const;
};

[[nodiscard]] Result<GlbPlan> plan_glb(const model::Model& model, const WriteOptions& options);

}  // namespace strake::io::gltf
