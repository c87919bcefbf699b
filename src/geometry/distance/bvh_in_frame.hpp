// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "geometry/bvh/pair_local_part.hpp"
#include "geometry/distance/triangle_distance.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "geometry/obb/rotated_part.hpp"

namespace strake::geometry {

/// A BVH whose boxes are given in the frame of a traversal: the pair's, or a rotated one.
class BvhInFrame {
 public:
  explicit BvhInFrame(const PairLocalPart& view)
      : tree_(&view.tree()), shift_(view.shift().as<double>()) {}
  explicit BvhInFrame(const RotatedPart& turned)
      : tree_(&turned.tree), turned_(&turned.part), margin_(kRotationRounding) {}

  [[nodiscard]] const TriangleBvh& tree() const { return *tree_; }
  /// Returns the box of a node; exact for a part's own tree.
  [[nodiscard]] Box3d box(const TriangleBvh::Node& node) const {
    return node.box.as<double>().moved(shift_).inflated(margin_);
  }
  [[nodiscard]] Box3d box(std::uint32_t node) const { return box(tree_->nodes()[node]); }
  /// Returns the box of a triangle, which is given in the part's own frame too.
  [[nodiscard]] Box3d box(std::uint32_t number, const DoubleTriangle& triangle) const {
    return turned_ == nullptr ? triangle.box : turned_box(number);
  }

  /// Returns the box of a triangle of a rotated part.
  [[nodiscard]] Box3d turned_box(std::uint32_t number) const {
    const Triangle& t = turned_->triangles[number];
    const auto& v = turned_->vertices;
    return box_of(std::array{v[t[0]], v[t[1]], v[t[2]]}).as<double>().inflated(margin_);
  }

 private:
  const TriangleBvh* tree_;
  const Part* turned_ = nullptr;
  Vec3d shift_;
  double margin_ = 0;
};

}  // namespace strake::geometry
