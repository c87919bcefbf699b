// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "strake/geometry/part.hpp"
#include "strake/geometry/part_pair.hpp"
#include "strake/geometry/triangle_bvh.hpp"

namespace strake::testing {

/// Triangles over a vertex list, before welding.
struct IndexedMesh {
  std::vector<geometry::Vec3i> vertices;
  std::vector<geometry::Triangle> triangles;

  void append(const IndexedMesh& other);
  /// The same triangles with inside and outside exchanged.
  [[nodiscard]] IndexedMesh flipped() const;
};

/// Welds equal vertices, drops degenerate triangles, builds edges and shells (connected through
/// edges). A solid when directed edges cancel, else a sheet. Orientation stays as given.
[[nodiscard]] geometry::Part build_part(const IndexedMesh& mesh);

/// The box with two opposite corners, outward.
[[nodiscard]] IndexedMesh box_mesh(const geometry::Vec3i& lo, const geometry::Vec3i& hi);

/// Two triangles p, p+u, p+u+v, p+v; the normal is u x v.
[[nodiscard]] IndexedMesh quad_mesh(const geometry::Vec3i& p, const geometry::Vec3i& u,
                                    const geometry::Vec3i& v);

/// A prism over a convex counter-clockwise polygon in a plane of constant z, from z0 to z1.
[[nodiscard]] IndexedMesh prism_mesh(std::span<const geometry::Vec3i> polygon, std::int32_t z0,
                                     std::int32_t z1);

/// A part with its tree; not copied, since the tree is referred to.
struct Subject {
  geometry::Part part;
  geometry::TriangleBvh tree;
  geometry::Vec3l origin;

  explicit Subject(const IndexedMesh& mesh, const geometry::Vec3l& at = {})
      : part(build_part(mesh)), tree(part), origin(at) {}
  [[nodiscard]] geometry::PartWithBvh treed() const { return {{&part, origin}, &tree}; }
};

}  // namespace strake::testing
