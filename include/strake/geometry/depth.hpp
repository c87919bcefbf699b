// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "strake/geometry/part_pair.hpp"
#include "strake/geometry/support_tree.hpp"

namespace strake::geometry {

/// Half-spaces that hold a part: for each of its distinct face normals n, the greatest n·v over all
/// its vertices. They bound depth from above, and they define convexity here: a part is as convex
/// as its vertices say, whatever its tags claim.
struct FaceKdop {
  struct Plane {
    Vec3d normal;        ///< unit, outward
    double support = 0;  ///< grid units, in the part's own coordinates, rounded outward
  };
  std::vector<Plane> planes;  ///< sorted by normal; of the largest faces when there are many
  std::array<double, 4> tetrahedral{};  ///< supports in four fixed directions
  SupportTree vertices;                 ///< for supports in any other direction
  std::array<Vec3d, 3> axes{};          ///< orthonormal_axes() of the part
  /// Every edge is convex to within a few grid units: the part is very nearly the intersection of
  /// its half-spaces.
  bool nearly_convex = false;
};

/// The four fixed unit directions of FaceKdop::tetrahedral; they sum to zero.
[[nodiscard]] const std::array<Vec3d, 4>& tetrahedral_directions();

/// The half-spaces of a part; the same for any team. The result is unusable where the context's
/// stop token ended the work.
[[nodiscard]] FaceKdop make_face_kdop(const Part& part, const parallel::Context& context = {});

/// A part of an interpenetrating pair.
struct DepthOperand {
  PartWithBvh treed;
  const FaceKdop* planes = nullptr;
};

/// Returns a certain lower bound on the distance of two parts: the widest gap between their
/// supports along the face normals of either. It is negative when no such direction separates them:
/// then moving one by that much does, so that they are no deeper in each other.
[[nodiscard]] double kdop_separation(const DepthOperand& a, const DepthOperand& b);

/// Depths up to this, grid units, need no deepest point: a known upper bound no greater is the
/// whole answer.
inline constexpr double kTieDepth = 2;

/// When a search for the depth may stop. All lengths are grid units. With these limits of work none
/// of 4,704 pairs of the kinds of bench deep_pairs keeps a wide bracket (decision 0055).
struct DepthOptions {
  double threshold = 0;                  ///< the depth that decides the class
  double tolerance = 8;                  ///< a bracket this narrow is narrow enough
  double relative = 0.02;                ///< so is a bracket this narrow relative to the depth
  std::uint32_t cells_undecided = 3000;  ///< work limit while the threshold lies in the bracket
  std::uint32_t cells_decided = 1000;    ///< work limit once it does not
  /// The caller does not distinguish depths up to this; the bracket may reach up to it.
  double negligible_depth = 0;
  /// A certain upper bound, if known: minus the result of kdop_separation().
  double known_upper = std::numeric_limits<double>::infinity();
  std::uint32_t triangle_a = kNoIndex, triangle_b = kNoIndex;  ///< where they meet, if known
  Vec3d meeting_point{};  ///< a point there, relative to a's origin
  /// A crossing of two sheets that vertex displacements no longer than this undo counts as none;
  /// two solids that they separate are as deep as touching ones (up to the tolerance).
  double apart_within = 0;
  /// Only points in this box, relative to a's origin, count.
  std::optional<Box3d> within = {};
  /// Where there are several contact regions: whether a point of both parts belongs to the one that
  /// is measured. A connected component of the intersection belongs as a whole.
  std::function<bool(const Vec3d&)> belongs = {};

  [[nodiscard]] bool counts(const Vec3d& p) const {
    return (!within || within->contains({p, p})) && (!belongs || belongs(p));
  }
};

/// Depth D of an interpenetrating pair, grid units: lower <= D <= upper is certain.
struct Depth {
  double lower = 0, upper = 0;
  double value = 0;  ///< nominal depth in [lower, upper]: that at `point`, but for ties (kTieDepth)
  Vec3d point;       ///< deepest point found, relative to a's origin
  std::uint64_t cells = 0;
  bool complete = true;  ///< no work limit left the bracket wide
};

/// The point of a part's surface nearest to a query point; grid units relative to the part's
/// origin.
struct SurfacePoint {
  Vec3d point;
  double distance = 0;
  Vec3d normal;  ///< unit, outward where the part is a solid
  std::uint32_t triangle = kNoIndex;
};

/// Returns the nearest point of the surface, to a relative error of about 1e-12; of triangles
/// equally near, the one with the lowest number.
[[nodiscard]] SurfacePoint nearest_on_surface(const PartWithBvh& part, const Vec3d& p);

/// Returns the depth of two solids: D = max over x in both of max(distance to a's surface, distance
/// to b's). D is NOT the minimal translation distance (penetration depth as EPA returns it) but the
/// largest distance to both surfaces over the common part; `away` of a clash witness (push_out in
/// reports) is the direction that moves the bodies apart at the deepest point.
///
/// Upper bound: two linear programs over the half-spaces of both (a ball inside a part is inside
/// all of the part's half-spaces), by weak duality; and since a translation changes D by no more
/// than its length, any short one that separates the interiors, decided exactly. Lower bound: a
/// point whose side is decided exactly, with its distances. Where the two differ by more than the
/// goal allows, as between parts that are not convex, points climb to where they are deepest
/// nearby, and the offset surfaces of either part, a little deeper than the deepest point known,
/// are searched for points of both. Work is limited by the goal; the bracket is certain wherever it
/// stops.
[[nodiscard]] Depth solid_depth(const DepthOperand& a, const DepthOperand& b,
                                const DepthOptions& goal, QueryContext& work);

/// Returns the depth of a sheet in a solid: D = max over x of the sheet in the solid of the
/// distance to the solid's surface. `point` is relative to the sheet's origin.
[[nodiscard]] Depth sheet_in_solid_depth(const DepthOperand& sheet, const DepthOperand& solid,
                                         const DepthOptions& goal, QueryContext& work);

/// Returns the depth of two sheets that cross: D = max over their intersection curve of the smaller
/// distance to their boundary curves. A sheet without a boundary curve counts as far away as it is
/// large. The depth is zero where DepthOptions::apart_within undoes the whole crossing.
[[nodiscard]] Depth sheet_crossing_depth(const PartWithBvh& a, const PartWithBvh& b,
                                         const DepthOptions& goal, QueryContext& work);

}  // namespace strake::geometry
