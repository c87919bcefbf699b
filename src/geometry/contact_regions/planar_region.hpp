// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "strake/geometry/part.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// A point in a plane.
struct PointInPlane {
  double x, y;  // no values of their own: large arrays of these are filled in part
};

/// How near is near, and what counts as in one plane: a share of that, and what the snap may have
/// moved. Grid units.
struct PlanarReach {
  static constexpr double kShare = 0.05, kSnap = 4;

  double reach = 0, band = 0;

  explicit PlanarReach(double near) : reach(near), band(std::max(kSnap, kShare * near)) {}
};

/// A plane square to an axis of unit length, with coordinates in it.
struct PlaneFrame : PlanarReach {
  Vec3d u, w;

  PlaneFrame(const Vec3d& axis, const PlanarReach& near);

  [[nodiscard]] PointInPlane put(const Vec3d& p) const { return {dot(u, p), dot(w, p)}; }
};

/// A part, a direction out of it along a plane's axis, and how far it reaches that way.
struct DirectedPart {
  const Part& part;
  Vec3d way;
  double top = 0;
  Vec3d shift;  ///< of the part's coordinates, into those of the pair
};

/// What of a part comes within reach of a plane: faces in it, and walls that leave it steeply.
class PlanarEnd {
 public:
  /// Nothing where more of the part is near, or leaves the plane at a flat angle.
  static std::optional<PlanarEnd> of(const DirectedPart& side, const PlaneFrame& plane);

  /// Whether it is one convex face.
  [[nodiscard]] bool is_convex() const;

  /// A side of one triangle in the plane alone, with the way from it into that triangle.
  struct OutlineEdge {
    std::uint32_t from = 0, to = 0;  ///< vertices of the part, ascending
    PointInPlane at_from, at_to, inward;
  };
  /// What bounds the faces, holes too.
  [[nodiscard]] std::vector<OutlineEdge> rim() const;

  /// Whether the triangles in the plane hang together over their sides, and no corner that reaches
  /// the plane is in none.
  [[nodiscard]] bool is_one_face() const;

  PlanarEnd(const DirectedPart& side, const PlaneFrame& plane)
      : part_(side.part),
        shift_(side.shift),
        plane_(plane),
        at_top_(side.part.vertices.size(), 0) {}

 private:
  /// Faces with more corners are left to others.
  static constexpr std::size_t kMostCorners = 512;

  [[nodiscard]] bool gather(const DirectedPart& side);
  [[nodiscard]] bool add_faces(const Vec3d& way);
  [[nodiscard]] bool lies_in_plane(const Triangle& t) const {
    return at_top_[t[0]] + at_top_[t[1]] + at_top_[t[2]] == 3;
  }
  /// The triangle in the plane that an edge alone bounds there.
  [[nodiscard]] const Triangle* only_face(std::uint32_t edge) const;

  const Part& part_;
  Vec3d shift_;
  const PlaneFrame& plane_;
  std::vector<std::uint8_t> at_top_;  ///< by vertex
  std::array<PointInPlane, kMostCorners> corners_;
  std::size_t count_ = 0;
  double area_ = 0;  ///< twice
};

/// Whether the faces of two ends have the same outline, so that they have one face in common, and
/// no more than that comes within reach: `gap` grid units lie between the planes of the two.
[[nodiscard]] bool outlines_coincide(const PlanarEnd& a, const PlanarEnd& b,
                                     const PlaneFrame& plane, double gap);

}  // namespace strake::geometry
