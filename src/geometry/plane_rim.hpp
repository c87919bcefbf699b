// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/pair_view.hpp"

namespace strake::geometry {

/// A side of a triangle: from corner `number` to the next one.
struct TriangleSide {
  std::uint32_t triangle = 0;
  int number = 0;
};

/// What bounds those faces of a part that lie in one coordinate plane: the sides of their triangles
/// but for those where just two of them go on into each other. In the coordinates of a pair; exact
/// where its differences are at most 2^31.
class PlaneRim {
 public:
  /// `triangles`: all of the part that lie in the plane square to an axis, all facing one way.
  PlaneRim(const PartView& view, std::span<const std::uint32_t> triangles, int axis);

  [[nodiscard]] std::span<const TriangleSide> sides() const { return sides_; }
  [[nodiscard]] std::array<Vec3l, 2> ends(const TriangleSide& side) const;

  /// Whether a segment in the plane has a point in common with the rim.
  [[nodiscard]] bool meets(const std::array<Vec3l, 2>& segment) const;

  /// For a point of the plane off the rim: a triangle at the rim of the face that it lies in, none
  /// where it lies in no face.
  [[nodiscard]] std::optional<std::uint32_t> face_round(const Vec3l& p) const;

 private:
  [[nodiscard]] bool share_point(const std::array<Vec3l, 2>& s,
                                 const std::array<Vec3l, 2>& t) const;

  PartView view_;
  int axis_;
  int facing_ = 1;  ///< 1 where the faces look along the axis, -1 against it
  std::vector<TriangleSide> sides_;
  Part segments_;  ///< the sides as triangles with two equal corners, for the tree
  PartTree tree_;
};

}  // namespace strake::geometry
