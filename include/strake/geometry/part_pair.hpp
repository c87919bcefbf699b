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

/// A part where it stands, with the tree over its triangles.
struct PartWithBvh {
  PlacedPart placed;
  const TriangleBvh* tree = nullptr;
};

/// How the point sets of two parts meet, decided exactly on the grid. For a solid the set is its
/// closed volume, for a sheet its surface.
///
/// Exact for solids whose triangles are the boundary of the body: inside on one side of each,
/// outside on the other (edges and vertices may be shared by any number of them). A mesh that
/// overlaps itself is still never missed when it crosses another part in plain sight or holds one,
/// but may be called `touching` where only its inner faces are met.
enum class Meeting : std::uint8_t {
  apart,       ///< no common point
  touching,    ///< common points, but no interior point of a solid in the other part's interior
               ///< (two sheets: they meet without crossing properly)
  crossing,    ///< interiors meet and neither part lies inside the other without contact. (The
               ///< boundaries meet too, unless a cavity of one lies inside the other.)
  a_inside_b,  ///< a lies in b, boundaries share no point
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

/// What a pair has cost: the same for any team.
struct QueryStats {
  std::uint64_t triangle_pairs = 0, exact_fallbacks = 0, node_pairs = 0;

  QueryStats& operator+=(const QueryStats& other) {
    triangle_pairs += other.triangle_pairs;
    exact_fallbacks += other.exact_fallbacks;
    node_pairs += other.node_pairs;
    return *this;
  }
};

/// Runs regions alone. A constant of the namespace: one of a function would ask a guard at each
/// call.
inline constinit const parallel::Context kSequentialContext;

/// A pair while it is worked on. What a heavy pair asks of a team that was stopped is not an
/// answer: who started the work looks at the stop token.
struct QueryContext : QueryStats {
  const parallel::Context* team = nullptr;  ///< who may help where a pair is heavy; null: nobody

  /// To run regions with.
  [[nodiscard]] const parallel::Context& context() const {
    return team == nullptr ? kSequentialContext : *team;
  }
};

/// Exact: see Meeting. The caller checks with fits_pair() first. Most pairs are decided by one
/// plane or one crossing and touch no heap; otherwise the cost is that of the contacts, plus one
/// ray a shell. Swapping a and b swaps the answer, whatever way the triangles are written down.
[[nodiscard]] MeetingResult meet(const PartWithBvh& a, const PartWithBvh& b, QueryContext& work);

/// True when the box of the two parts together measures at most 2^31 units (2.1 km) along each
/// axis, as the exact arithmetic of a pair needs.
[[nodiscard]] bool fits_pair(const PlacedPart& a, const PlacedPart& b);

/// The closest pair of points of two surfaces.
struct ClosestPair {
  double squared = 0;   ///< grid units², the exact rational rounded to nearest
  double distance = 0;  ///< its square root, rounded
  double lower = 0;     ///< no points are nearer; the distance itself unless closest() had slack
  Vec3d on_a, on_b;     ///< grid units relative to a's origin
  /// The lowest ids among exact ties, but for two flat faces of very many needles: there the first
  /// that the walk finds, which is the same for any team.
  std::uint32_t triangle_a = kNoIndex, triangle_b = kNoIndex;
};

/// The minimum Euclidean distance between the surfaces, if it is below `limit` grid units; the
/// work follows the output, not the gap. Zero when they share a point.
///
/// With `slack` (grid units) a heavy pair may be answered by two points that are farther apart than
/// the nearest by up to so much, `lower` telling how near those can be: flat faces that stand askew
/// are snapped to a roughness of a few units, and which of their needles come nearest in it is work
/// of the square of their number.
///
/// `parting`, a unit vector from b to a, is a hint that changes no answer but such a one: where the
/// parts come nearest each other at the two ends of the widest slab between them, as convex ones
/// do, the triangles there are all that is looked at.
[[nodiscard]] std::optional<ClosestPair> find_closest_pair(
    const PartWithBvh& a, const PartWithBvh& b, double limit, QueryContext& work, double slack = 0,
    const std::optional<Vec3d>& parting = {});

/// Two triangles nearer than `distance` grid units, the first that are found, with their own
/// closest points: not the closest of the parts, but far cheaper where whole faces are about
/// equally near. May find none where the distance is within rounding of the limit.
[[nodiscard]] std::optional<ClosestPair> find_pair_within(const PartWithBvh& a,
                                                          const PartWithBvh& b, double distance,
                                                          QueryContext& work);

/// Exact side of a rational point: numerator / denominator in grid units relative to the part's
/// origin, denominator in 1..4096.
[[nodiscard]] PointSide side_of(const PartWithBvh& part, const Vec3l& numerator,
                                std::int64_t denominator, QueryContext& work);

/// Distance of a point (grid units relative to the part's origin) to the part's surface.
[[nodiscard]] double distance_to_surface(const PartWithBvh& part, const Vec3d& point,
                                         double limit = std::numeric_limits<double>::infinity());

/// Where the vertices of one part lie in another.
struct ToleranceContainment {
  bool within = false;      ///< each inside, or within the band of the surface
  bool on_surface = false;  ///< each within the band of the surface; says nothing if not within
};

/// The vertices of `a` in `b` with a band of so many grid units round it; all are looked at up to
/// the first that lies outside.
[[nodiscard]] ToleranceContainment containment_within(const PartWithBvh& a, const PartWithBvh& b,
                                                      double band, QueryContext& work);

}  // namespace strake::geometry
