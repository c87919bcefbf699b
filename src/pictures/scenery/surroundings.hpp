// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pictures/scenery/clash_place.hpp"
#include "pictures/viewpoint.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::pictures {

/// A triangle near a clash, mm from a point of the model.
struct NearTriangle {
  std::array<geometry::Vec3d, 3> at;
  Role role = Role::other;
  bool solid = true;  ///< of a body that has an inside: its back shows only where it is cut
};

/// Triangles that follow each other and are all of the clash, or none of them.
struct TriangleRun {
  std::uint32_t first = 0, end = 0;
  geometry::Box3d box = geometry::empty_box<double>();  ///< round all of them
};

/// Triangles near a clash in short runs, so that a view passes over those that it does not show
/// without a look at each.
class NearTriangles {
 public:
  explicit NearTriangles(std::vector<NearTriangle> triangles);

  [[nodiscard]] std::span<const NearTriangle> all() const { return triangles_; }
  [[nodiscard]] const NearTriangle& operator[](std::uint32_t number) const {
    return triangles_[number];
  }
  /// The runs of the clash's own triangles, or of all others, in the order of the triangles.
  [[nodiscard]] std::span<const TriangleRun> runs(bool own) const { return own ? own_ : others_; }

 private:
  std::vector<NearTriangle> triangles_;
  std::vector<TriangleRun> own_, others_;
};

/// Returns the triangles that meet a cube round a point of the grid, `half_mm` to each side; what
/// is transparent and not of the clash is left out. They come by body, part and number.
[[nodiscard]] std::vector<NearTriangle> triangles_near(const Scenery& scenery, const Roles& roles,
                                                       const geometry::Vec3l& point,
                                                       double half_mm);

}  // namespace strake::pictures
