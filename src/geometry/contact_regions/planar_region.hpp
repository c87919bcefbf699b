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

// The ends of parts at a plane, for contacts in one planar region.

namespace strake::geometry {

/// A point in a plane.
struct PointInPlane {
  double x, y;  // not initialised: large arrays of these are filled in part
};

/// The reach of a contact and the band that counts as one plane: a share of the reach, but at least
/// what the snap may have moved. Grid units.
struct PlanarReach {
  static constexpr double kShare = 0.05, kSnap = 4;

  double reach = 0, band = 0;

  explicit PlanarReach(double near) : reach(near), band(std::max(kSnap, kShare * near)) {}
};

/// A plane perpendicular to a unit axis, with coordinates in it.
struct PlaneFrame : PlanarReach {
  Vec3d u, w;

  PlaneFrame(const Vec3d& axis, const PlanarReach& near);

  [[nodiscard]] PointInPlane put(const Vec3d& p) const { return {dot(u, p), dot(w, p)}; }
};

/// A part, a direction out of it along a plane's axis, and how far the part reaches in that
/// direction.
struct DirectedPart {
  const Part& part;
  Vec3d way;
  double top = 0;
  Vec3d shift;  ///< from the part's coordinates into those of the pair
};

/// The end of a part within reach of a plane: faces in it, and walls that leave it steeply.
class PlanarEnd {
 public:
  /// Returns the end of a part; nothing where more of the part is near, or leaves the plane at a
  /// flat angle.
  static std::optional<PlanarEnd> of(const DirectedPart& side, const PlaneFrame& plane);

  /// Whether the end is one convex face.
  [[nodiscard]] bool is_convex() const;

  /// An edge of only one triangle in the plane, with the direction from it into that triangle.
  struct OutlineEdge {
    std::uint32_t from = 0, to = 0;  ///< vertices of the part, ascending
    PointInPlane at_from, at_to, inward;
  };
  /// Returns the border edges of the faces, including holes.
  [[nodiscard]] std::vector<OutlineEdge> rim() const;

  /// Whether the triangles in the plane are connected over their edges, and each vertex that
  /// reaches the plane is in one of them.
  [[nodiscard]] bool is_one_face() const;

  PlanarEnd(const DirectedPart& side, const PlaneFrame& plane)
      : part_(side.part),
        shift_(side.shift),
        plane_(plane),
        at_top_(side.part.vertices.size(), 0) {}

 private:
  /// Faces with more corners are left to other methods.
  static constexpr std::size_t kMostCorners = 512;

  [[nodiscard]] bool gather(const DirectedPart& side);
  [[nodiscard]] bool add_faces(const Vec3d& way);
  [[nodiscard]] bool lies_in_plane(const Triangle& t) const {
    return at_top_[t[0]] + at_top_[t[1]] + at_top_[t[2]] == 3;
  }
  /// Returns the only triangle in the plane at an edge; null otherwise.
  [[nodiscard]] const Triangle* only_face(std::uint32_t edge) const;

  const Part& part_;
  Vec3d shift_;
  const PlaneFrame& plane_;
  std::vector<std::uint8_t> at_top_;  ///< by vertex
  std::array<PointInPlane, kMostCorners> corners_;
  std::size_t count_ = 0;
  double area_ = 0;  ///< twice the area
};

/// Whether the faces of two ends have the same outline, so that they share one face, and nothing
/// else comes within reach; `gap` grid units lie between their planes.
[[nodiscard]] bool outlines_coincide(const PlanarEnd& a, const PlanarEnd& b,
                                     const PlaneFrame& plane, double gap);

}  // namespace strake::geometry
