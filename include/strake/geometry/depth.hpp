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

/// Half-spaces that hold a part: for each of its distinct face normals n, the greatest n·v over
/// all its vertices. What bounds depth from above, and what convexity means here: a part is as
/// convex as its vertices say, whatever its tags claim.
struct FaceKdop {
  struct Plane {
    Vec3d normal;        ///< unit, outward
    double support = 0;  ///< grid units, in the part's own coordinates, rounded outward
  };
  std::vector<Plane> planes;            ///< by normal; the largest faces when there are many
  std::array<double, 4> tetrahedral{};  ///< supports in four fixed directions
  SupportTree vertices;                 ///< for supports in any other direction
  std::array<Vec3d, 3> axes{};          ///< orthonormal_axes() of the part
  /// Every edge is convex to within a few grid units: the part very nearly is its half-spaces.
  bool nearly_convex = false;
};

/// The four fixed unit directions of FaceKdop::tetrahedral; they sum to zero.
[[nodiscard]] const std::array<Vec3d, 4>& tetrahedral_directions();

/// The same with any team or none; of no use where the context's stop token ended it.
[[nodiscard]] FaceKdop make_face_kdop(const Part& part, const parallel::Context& context = {});

/// A part of an interpenetrating pair.
struct DepthOperand {
  PartWithBvh treed;
  const FaceKdop* planes = nullptr;
};

/// A certain lower bound on the distance of two parts: the widest gap between their supports along
/// the face normals of either. Negative when no such direction keeps them apart: then moving one by
/// that much parts them, so that they are no deeper in each other.
[[nodiscard]] double kdop_separation(const DepthOperand& a, const DepthOperand& b);

/// A depth in which nobody needs the deepest point, grid units: a known upper bound no greater is
/// the whole answer.
inline constexpr double kTieDepth = 2;

/// When to stop. All lengths are grid units.
struct DepthOptions {
  double threshold = 0;                  ///< the depth that decides the class
  double tolerance = 8;                  ///< a bracket this narrow is narrow enough,
  double relative = 0.02;                ///< and so is one this narrow relative to the depth
  std::uint32_t cells_undecided = 3000;  ///< work limit while the threshold lies in the bracket
  std::uint32_t cells_decided = 1000;    ///< work limit once it does not
  /// Depths of no more than this are all the same to who asks; the bracket may reach up to it.
  double negligible_depth = 0;
  /// A certain upper bound, if known: minus the result of kdop_separation().
  double known_upper = std::numeric_limits<double>::infinity();
  std::uint32_t triangle_a = kNoIndex, triangle_b = kNoIndex;  ///< where the two meet, if known,
  Vec3d meeting_point{};  ///< and a point there, relative to a's origin
  /// What moves of corners that are no longer than this undo is no crossing of two sheets, and of
  /// two solids a touch as good as any (up to the tolerance).
  double apart_within = 0;
  /// Only points in this box, relative to a's origin, count.
  std::optional<Box3d> within = {};
  /// And of those, where there are several places: whether a point of both belongs to the one asked
  /// about. A connected part of what is common belongs as a whole.
  std::function<bool(const Vec3d&)> belongs = {};

  [[nodiscard]] bool counts(const Vec3d& p) const {
    return (!within || within->contains({p, p})) && (!belongs || belongs(p));
  }
};

/// Depth D of an interpenetrating pair, grid units: lower <= D <= upper is certain.
struct Depth {
  double lower = 0, upper = 0;
  double value = 0;  ///< the nominal depth, in [lower, upper]: that at `point`, but for ties
  Vec3d point;       ///< deepest point found, relative to a's origin
  std::uint64_t cells = 0;
  bool complete = true;  ///< no work limit left the bracket wide
};

/// The point of a part's skin nearest to a point; lengths and coordinates are grid units relative
/// to the part's origin.
struct SurfacePoint {
  Vec3d point;
  double distance = 0;
  Vec3d normal;  ///< unit, outward where the part is a solid
  std::uint32_t triangle = kNoIndex;
};

/// Relative error about 1e-12; of triangles equally near, the lowest.
[[nodiscard]] SurfacePoint nearest_on_surface(const PartWithBvh& part, const Vec3d& p);

/// Two solids: D = max over x in both of max(distance to a's surface, distance to b's).
///
/// Upper bound: two linear programs over the half-spaces of both (what is in a ball inside a part
/// is inside all of the part's half-spaces), by weak duality; and since a translation changes D by
/// no more than its length, any short one that exactly parts the interiors. Lower bound: a point
/// whose side is decided exactly, with its distances. Where the two differ by more than the goal
/// allows, as between parts that are not convex, points climb to where they are deepest nearby, and
/// the surfaces parallel to either skin, a little deeper than the deepest point known, are searched
/// for points of both.
/// Work is limited by the goal; the bracket is certain wherever it stops.
[[nodiscard]] Depth solid_depth(const DepthOperand& a, const DepthOperand& b,
                                const DepthOptions& goal, QueryContext& work);

/// A sheet and a solid: D = max over x of the sheet in the solid of the distance to the solid's
/// surface. `point` is relative to the sheet's origin.
[[nodiscard]] Depth sheet_in_solid_depth(const DepthOperand& sheet, const DepthOperand& solid,
                                         const DepthOptions& goal, QueryContext& work);

/// Two sheets that cross: D = max over the curve that they share of the smaller distance to their
/// boundary curves. A sheet without a boundary curve counts as far away as it is large. All zero
/// where DepthOptions::apart_within undoes all of it.
[[nodiscard]] Depth sheet_crossing_depth(const PartWithBvh& a, const PartWithBvh& b,
                                         const DepthOptions& goal, QueryContext& work);

}  // namespace strake::geometry
