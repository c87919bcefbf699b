// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "geometry/mesh_repair/mesh_repair.hpp"
#include "geometry/mesh_repair/snap_to_grid.hpp"
#include "strake/model/scene.hpp"

namespace strake::model {

/// A shape under one linear map, with what was noticed on the way.
struct GridShapeResult {
  GridShape shape;
  geometry::RepairCounts findings;
  std::uint64_t bad_triangles = 0;
  std::uint64_t bad_points = 0;
  std::string_view fault;  ///< why the shape has no parts; empty when it has some
  bool vanished = false;   ///< because nothing is left on the grid of what is sound
};

struct GridShapeOptions {
  double sag_mm = 0.5;
  geometry::Seams seams = {};  ///< the seams of meshes to close
  /// The view whose contours primitives get, if there is one; see geometry::tessellate().
  std::optional<geometry::Vec3d> towards = std::nullopt;
  /// The eye, millimetres from the placed origin of the primitive, in a view in perspective.
  std::optional<geometry::Vec3d> eye = std::nullopt;
};

/// Makes shapes one after another in memory that it keeps; each worker has one.
class GridShapeBuilder {
 public:
  [[nodiscard]] GridShapeResult make(const Shape& shape, const geometry::Mat3d& linear,
                                     const GridShapeOptions& options);

 private:
  void add_mesh(const geometry::TriangleMesh& mesh, const geometry::Mat3d& linear,
                const geometry::Seams& seams, GridShapeResult& result);
  void add_primitive(const geometry::Primitive& primitive, const geometry::Mat3d& linear,
                     const GridShapeOptions& options, GridShapeResult& result);

  geometry::GridSnapper placer_;
  geometry::MeshRepairer analyser_;
};

}  // namespace strake::model
