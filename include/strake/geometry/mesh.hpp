// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "strake/geometry/vec.hpp"

namespace strake::geometry {

using Triangle = std::array<std::uint32_t, 3>;

inline constexpr std::uint32_t kNoIndex = 0xffffffffU;

/// Triangles as a file gives them: double coordinates in millimetres, outward side
/// counter-clockwise where the source says so.
struct TriangleMesh {
  std::vector<Vec3d> vertices;
  std::vector<Triangle> triangles;
  /// The source face (planar polygon) that each triangle belongs to: edges between two triangles of
  /// one face are never drawn. Empty, or one entry per triangle (kNoIndex: a face of its own).
  std::vector<std::uint32_t> faces;
  /// Largest distance of the mesh from the surface that it stands for, in mm; negative: unknown.
  double sag_mm = -1;
};

/// Open or closed chains of points, in millimetres; each is drawn, and clashes only where asked
/// for.
struct Polylines {
  std::vector<Vec3d> points;
  /// Chain i is points[first[i] .. first[i + 1]); first has one entry more than there are chains.
  std::vector<std::uint32_t> first{0};
};

}  // namespace strake::geometry
