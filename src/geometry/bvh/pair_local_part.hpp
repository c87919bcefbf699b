// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "strake/geometry/part_pair.hpp"
#include "strake/geometry/triangle_contact.hpp"

namespace strake::geometry {

/// A part in the coordinates of a pair (relative to the origin of the pair's first part).
class PairLocalPart {
 public:
  PairLocalPart(const PartWithBvh& treed, const Vec3l& shift)
      : part_(treed.placed.part), tree_(treed.tree), shift_(shift) {}

  [[nodiscard]] const Part& part() const { return *part_; }
  [[nodiscard]] const TriangleBvh& tree() const { return *tree_; }
  [[nodiscard]] bool has_bvh() const { return tree_ != nullptr && !tree_->nodes().empty(); }
  [[nodiscard]] const Vec3l& shift() const { return shift_; }
  [[nodiscard]] bool solid() const { return part_->kind == PartKind::solid; }

  [[nodiscard]] Vec3l vertex(std::uint32_t v) const {
    return part_->vertices[v].as<std::int64_t>() + shift_;
  }
  [[nodiscard]] std::array<Vec3l, 3> corners(std::uint32_t triangle) const {
    const Triangle& t = part_->triangles[triangle];
    return {vertex(t[0]), vertex(t[1]), vertex(t[2])};
  }
  [[nodiscard]] ExactTriangle triangle(std::uint32_t i) const { return ExactTriangle(corners(i)); }
  [[nodiscard]] Box3l box(const Box3i& b) const { return b.as<std::int64_t>().moved(shift_); }

 private:
  const Part* part_;
  const TriangleBvh* tree_;
  Vec3l shift_;
};

/// Both trees have at most this depth (see TriangleBvh), so their traversal needs no heap.
inline constexpr std::size_t kMaxTreeDepth = 72;

struct NodePair {
  std::uint32_t a = 0, b = 0;
};

/// Whether the first of two nodes is the one to descend into: the larger, unless it is a leaf.
[[nodiscard]] inline bool open_first(const TriangleBvh::Node& a, const TriangleBvh::Node& b) {
  if (a.count != 0) return false;
  if (b.count != 0) return true;
  const auto size = [](const Box3i& box) {
    return std::int64_t{box.hi.x} - box.lo.x + box.hi.y - box.lo.y + box.hi.z - box.lo.z;
  };
  return size(a.box) >= size(b.box);
}

}  // namespace strake::geometry
