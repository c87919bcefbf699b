// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0002 says why contacts in coordinate planes need no tree.
// Decision 0024 says why large coplanar faces are judged by their boundaries.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/bvh/pair_local_part.hpp"
#include "strake/geometry/part.hpp"

namespace strake::geometry {

/// What the boxes of two parts say about how the parts meet.
struct CoplanarContact {
  /// A coordinate plane lies between the two (or holds the contact): their interiors are disjoint
  /// and no sheet crosses another.
  bool separated = false;
  bool touching = false;  ///< a common point was found, in that plane
  Vec3d point;            ///< that point, grid units relative to a's origin
};

/// Most contacts of a real model are flush with a coordinate plane: a deck and what stands on it.
/// They are decided exactly from the triangles in that plane alone, without a tree.
///
/// `separated` without `touching` says that the parts do not meet in the plane or that there are
/// too many triangles in it to try all pairs: ask closest().
[[nodiscard]] CoplanarContact find_coplanar_contact(const PlacedPart& a, const PlacedPart& b);

/// A coordinate plane in which many triangles of each of two solids lie, those of either all facing
/// one way. Numbers are ascending.
struct CoplanarFaces {
  int axis = 0;
  std::int64_t height = 0;               ///< in the coordinates of the pair
  std::vector<std::uint32_t> a, b;       ///< all triangles in the plane
  std::vector<std::uint32_t> through_a;  ///< the others that meet it in more than their own rim
  std::vector<std::uint32_t> through_b;  ///< of `a`, or of `b`, and single points
};

/// The planes with the most pairs of triangles, as few as are worth a look; none where they hold
/// but a small share of all. O(n log n).
[[nodiscard]] std::vector<CoplanarFaces> find_coplanar_faces(const PairLocalPart& a,
                                                             const PairLocalPart& b);

/// A side of a triangle: from corner `number` to the next one.
struct TriangleEdge {
  std::uint32_t triangle = 0;
  int number = 0;
};

/// What bounds those faces of a part that lie in one coordinate plane: the sides of their triangles
/// but for those where just two of them go on into each other. In the coordinates of a pair; exact
/// where its differences are at most 2^31.
class FaceBoundary {
 public:
  /// `triangles`: all of the part that lie in the plane square to an axis, all facing one way.
  FaceBoundary(const PairLocalPart& view, std::span<const std::uint32_t> triangles, int axis);

  [[nodiscard]] std::span<const TriangleEdge> sides() const { return sides_; }
  [[nodiscard]] std::array<Vec3l, 2> ends(const TriangleEdge& side) const;

  /// Whether a segment in the plane has a point in common with the rim.
  [[nodiscard]] bool meets(const std::array<Vec3l, 2>& segment) const;

  /// For a point of the plane off the rim: a triangle at the rim of the face that it lies in, none
  /// where it lies in no face.
  [[nodiscard]] std::optional<std::uint32_t> face_containing(const Vec3l& p) const;

 private:
  [[nodiscard]] bool share_point(const std::array<Vec3l, 2>& s,
                                 const std::array<Vec3l, 2>& t) const;

  PairLocalPart view_;
  int axis_;
  int facing_ = 1;  ///< 1 where the faces look along the axis, -1 against it
  std::vector<TriangleEdge> sides_;
  Part segments_;  ///< the sides as triangles with two equal corners, for the tree
  TriangleBvh tree_;
};

}  // namespace strake::geometry
