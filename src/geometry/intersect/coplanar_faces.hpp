// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0002 says why contacts in coordinate planes need no tree.
// Decision 0024 says why large coplanar faces are compared by their boundaries.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/bvh/pair_local_part.hpp"
#include "strake/geometry/part.hpp"

// Contact of two parts in coordinate planes: coplanar faces and their boundaries.

namespace strake::geometry {

/// The contact of two parts in a coordinate plane between their boxes.
struct CoplanarContact {
  /// A coordinate plane lies between the two (or holds the contact): their interiors are disjoint
  /// and no sheet crosses another.
  bool separated = false;
  bool touching = false;  ///< a common point was found, in that plane
  Vec3d point;            ///< that point, grid units relative to a's origin
};

/// Returns the contact of two parts in a coordinate plane. Most contacts of a real model lie in
/// one, as those of a deck and what stands on it. They are decided exactly from the triangles in
/// that plane alone, without a tree.
///
/// `separated` without `touching` means that the parts do not meet in the plane or that it holds
/// too many triangles to try all pairs: use find_closest_pair().
[[nodiscard]] CoplanarContact find_coplanar_contact(const PlacedPart& a, const PlacedPart& b);

/// A coordinate plane that holds many triangles of each of two solids, those of either all facing
/// one way. Lists are ascending.
struct CoplanarFaces {
  int axis = 0;
  std::int64_t height = 0;               ///< in the coordinates of the pair
  std::vector<std::uint32_t> a, b;       ///< all triangles in the plane
  std::vector<std::uint32_t> through_a;  ///< those that meet the plane in more than
  std::vector<std::uint32_t> through_b;  ///< the boundary of `a`, or of `b`, and single points
};

/// Returns the few planes with the most pairs of triangles; none where these are but a small share
/// of all. O(n log n).
[[nodiscard]] std::vector<CoplanarFaces> find_coplanar_faces(const PairLocalPart& a,
                                                             const PairLocalPart& b);

/// An edge of a triangle: from corner `number` to the next one.
struct TriangleEdge {
  std::uint32_t triangle = 0;
  int number = 0;
};

/// The boundary of those faces of a part that lie in one coordinate plane: the edges of their
/// triangles, except those that just two of them share. In the coordinates of a pair; exact where
/// its differences are at most 2^31.
class FaceBoundary {
 public:
  /// `triangles`: all of the part that lie in the plane perpendicular to an axis, all facing one
  /// way.
  FaceBoundary(const PairLocalPart& view, std::span<const std::uint32_t> triangles, int axis);

  [[nodiscard]] std::span<const TriangleEdge> sides() const { return sides_; }
  [[nodiscard]] std::array<Vec3l, 2> ends(const TriangleEdge& side) const;

  /// Whether a segment in the plane has a point in common with the boundary.
  [[nodiscard]] bool meets(const std::array<Vec3l, 2>& segment) const;

  /// Returns, for a point of the plane off the boundary, a triangle at the boundary of the face
  /// that holds it; none where no face does.
  [[nodiscard]] std::optional<std::uint32_t> face_containing(const Vec3l& p) const;

 private:
  [[nodiscard]] bool share_point(const std::array<Vec3l, 2>& s,
                                 const std::array<Vec3l, 2>& t) const;

  PairLocalPart view_;
  int axis_;
  int facing_ = 1;  ///< 1 where the normals point along the axis, -1 against it
  std::vector<TriangleEdge> sides_;
  Part segments_;  ///< the edges as triangles with two equal corners, for the tree
  TriangleBvh tree_;
};

}  // namespace strake::geometry
