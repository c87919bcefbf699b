// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "strake/geometry/inside.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/triangle_bvh.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/parallel/context.hpp"

namespace strake::geometry {

/// A placed part with the BVH over its triangles.
struct PartWithBvh {
  PlacedPart placed;
  const TriangleBvh* tree = nullptr;
};

/// How the point sets of two parts intersect, decided exactly on the grid. For a solid the set is
/// its closed volume, for a sheet its surface.
///
/// Exact for solids whose triangles are the boundary of the body: the inside lies on one side of
/// each, the outside on the other (any number of them may share edges and vertices). A mesh that
/// overlaps itself is still never missed when its outer surface crosses another part or it contains
/// one, but may be reported as `touching` where only its inner faces are met.
enum class Meeting : std::uint8_t {
  apart,       ///< no common point
  touching,    ///< common points, but no interior point of a solid in the other part's interior
               ///< (two sheets: they meet without crossing properly)
  crossing,    ///< interiors intersect and neither part lies inside the other without contact. (The
               ///< boundaries intersect too, unless a cavity of one lies inside the other.)
  a_inside_b,  ///< a lies in b; the boundaries share no point
  b_inside_a,
};

/// Refinement of a Meeting.
struct MeetingResult {
  Meeting meeting = Meeting::apart;
  bool boundaries_meet = false;
  bool a_within_b = false;  ///< closed: no point of a lies outside b (abutting inside, or equal)
  bool b_within_a = false;
  Vec3d point;  ///< a common point, grid units relative to a's origin, if any
  std::uint32_t triangle_a = kNoIndex, triangle_b = kNoIndex;  ///< where it was found, if on both
};

/// Work counters of a pair's queries; the same for any team.
struct QueryStats {
  std::uint64_t triangle_pairs = 0, exact_fallbacks = 0, node_pairs = 0;

  QueryStats& operator+=(const QueryStats& other) {
    triangle_pairs += other.triangle_pairs;
    exact_fallbacks += other.exact_fallbacks;
    node_pairs += other.node_pairs;
    return *this;
  }
};

/// A context without a team: regions run sequentially. It is a constant of the namespace, since a
/// function-local one would check a guard at each call.
inline constinit const parallel::Context kSequentialContext;

/// The work counters and the team of the queries on a pair. Results for a heavy pair whose team was
/// stopped are invalid: the caller checks the stop token.
struct QueryContext : QueryStats {
  const parallel::Context* team = nullptr;  ///< shares the work of a heavy pair; null: sequential

  /// Returns the context to run regions with.
  [[nodiscard]] const parallel::Context& context() const {
    return team == nullptr ? kSequentialContext : *team;
  }
};

/// Returns the exact relation of two parts: see Meeting. The caller checks fits_pair() first. Most
/// pairs are decided by one plane or one crossing without allocation; otherwise the cost is that of
/// the contacts, plus one ray per shell. Swapping a and b swaps the result, in whatever order the
/// triangles are.
[[nodiscard]] MeetingResult meet(const PartWithBvh& a, const PartWithBvh& b, QueryContext& work);

/// Whether the common bounding box of the two parts measures at most 2^31 units (2.1 km) along each
/// axis, as the exact arithmetic of a pair needs.
[[nodiscard]] bool fits_pair(const PlacedPart& a, const PlacedPart& b);

/// The closest points of two surfaces.
struct ClosestPair {
  double squared = 0;   ///< grid units², the exact rational rounded to nearest
  double distance = 0;  ///< its square root, rounded
  double lower =
      0;  ///< no points are nearer; equals `distance` unless find_closest_pair() had slack
  Vec3d on_a, on_b;  ///< grid units relative to a's origin
  /// The lowest numbers among exact ties, but for two flat faces of very many slivers: there the
  /// first that the traversal finds, which is the same for any team.
  std::uint32_t triangle_a = kNoIndex, triangle_b = kNoIndex;
};

/// Returns the minimum Euclidean distance of the surfaces, if it is below `limit` grid units, and
/// zero when they share a point; the work depends on the output, not on the gap.
///
/// With `slack` (grid units) a heavy pair may be answered by two points that are farther apart than
/// the nearest by up to so much, and `lower` bounds how near those can be: rotated flat faces are
/// snapped to a roughness of a few units, and finding their nearest slivers within it takes work of
/// the square of their number.
///
/// `separating_direction`, a unit vector from b to a, is a hint that changes only results with
/// slack: where the parts come nearest at the two ends of the widest slab between them, as convex
/// ones do, only the triangles there are visited.
[[nodiscard]] std::optional<ClosestPair> find_closest_pair(
    const PartWithBvh& a, const PartWithBvh& b, double limit, QueryContext& work, double slack = 0,
    const std::optional<Vec3d>& separating_direction = {});

/// Returns the first two triangles found that are nearer than `distance` grid units, with their own
/// closest points: not the closest of the parts, but far cheaper where whole faces are about
/// equally near. It may find none where the distance is within rounding of the limit.
[[nodiscard]] std::optional<ClosestPair> find_pair_within(const PartWithBvh& a,
                                                          const PartWithBvh& b, double distance,
                                                          QueryContext& work);

/// Returns the exact location of a rational point: numerator / denominator in grid units relative
/// to the part's origin, denominator in 1..4096.
[[nodiscard]] PointSide side_of(const PartWithBvh& part, const Vec3l& numerator,
                                std::int64_t denominator, QueryContext& work);

/// Returns the distance of a point (grid units relative to the part's origin) to the part's
/// surface.
[[nodiscard]] double distance_to_surface(const PartWithBvh& part, const Vec3d& point,
                                         double limit = std::numeric_limits<double>::infinity());

/// Whether the vertices of one part lie in another, with a tolerance.
struct ToleranceContainment {
  bool within = false;      ///< each is inside, or within the band of the surface
  bool on_surface = false;  ///< each is within the band of the surface; undefined unless `within`
};

/// Locates the vertices of `a` in `b`, whose surface gets a band of `band` grid units; stops at the
/// first vertex that lies outside.
[[nodiscard]] ToleranceContainment containment_within(const PartWithBvh& a, const PartWithBvh& b,
                                                      double band, QueryContext& work);

}  // namespace strake::geometry
