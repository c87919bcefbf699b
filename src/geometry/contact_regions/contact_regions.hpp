// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0012 says why a region is a component of near pairs of points.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "geometry/obb/oriented_box.hpp"
#include "strake/geometry/part_pair.hpp"

namespace strake::geometry {

/// One of the regions in which two parts meet or come near. Coordinates are grid units relative to
/// the first part's origin.
struct ContactRegion {
  Box3d extent = empty_box<double>();  ///< contains the region
  /// The nearest points of the two surfaces there; distance 0 where they meet.
  ClosestPair nearest;
  double least = 0;  ///< a certain lower bound on that distance
};

/// What to find out about a region that turns out to be the only one.
enum class SingleRegionDetail : std::uint8_t {
  counted,    ///< nothing: the list has one empty entry
  boxed,      ///< its extent, of the surfaces alone
  described,  ///< everything
};

struct ContactRegionOptions {
  double reach = 0;             ///< how near is near, grid units
  double distance = 0;          ///< of the two parts, where known: it only selects the method
  bool interiors_meet = false;  ///< as meet() returned
  SingleRegionDetail one = SingleRegionDetail::described;
  std::uint64_t max_pairs = std::uint64_t{1}
                            << 22U;  ///< of near triangles, before the search is given up
};

/// Returns the contact regions of two parts: the connected components of the set of pairs of
/// points, one of each body, no farther apart than the reach. With reach 0 these are the connected
/// components of the bodies' intersection. The body of a solid is its volume, so that a pipe
/// through a wall makes one region and not two; that of a sheet is its surface.
///
/// The set of pairs of points of two surfaces is the union, over pairs of triangles, of convex sets
/// that overlap exactly where a triangle of the one comes within reach of an edge of a triangle of
/// the other. So the pairs of triangles are joined over their edges and, where interiors intersect,
/// along the segments of edges, and of lines across faces, that run through the other's interior.
///
/// Distances are compared in double arithmetic and sides a 4096th of a grid unit off the line, so
/// regions within a grid unit of being one may be either. Two surfaces of one body (its outside and
/// a cavity) with only its material between them are not joined. Nothing where there are more than
/// `max_pairs` pairs of near triangles, or where a sample of the triangles, taken in heavy
/// traversals, shows about twice as many; an empty list where no surfaces are near: one body far
/// inside the other.
[[nodiscard]] std::optional<std::vector<ContactRegion>> contact_regions(
    const PartWithBvh& a, const PartWithBvh& b, const ContactRegionOptions& options,
    QueryContext& work);

/// A point of one part's surface.
struct ContactSurfacePoint {
  bool of_a = true;            ///< whether it is a's surface
  std::uint32_t triangle = 0;  ///< its triangle there
  Vec3d point;                 ///< grid units relative to a's origin
};

/// The contact regions, with functions that tell which of them a point or a pair of triangles
/// belongs to, also where their boxes overlap.
struct ContactRegions {
  std::vector<ContactRegion> all;
  /// Returns the number of the region of a surface point in the other body or near its surface;
  /// none where that is not known. The parts and their trees must outlive it.
  std::function<std::optional<std::uint32_t>(const ContactSurfacePoint&)> region_of;
  /// Returns the number of the region of a triangle of a and one of b within reach of each other.
  std::function<std::optional<std::uint32_t>(std::uint32_t, std::uint32_t)> region_of_pair;
};
[[nodiscard]] std::optional<ContactRegions> find_contact_regions(
    const PartWithBvh& a, const PartWithBvh& b, const ContactRegionOptions& options,
    QueryContext& work);

/// Returns a box, relative to a's origin, that contains the intersection of two parts and where
/// their surfaces come within reach of each other: it covers what of either surface lies in the
/// oriented box of the other. Both have oriented boxes; they do come within reach.
[[nodiscard]] Box3d overlap_extent(const PartWithObb& a, const PartWithObb& b, double reach);

/// Whether flat faces alone prove that two parts that come within reach of each other do so in one
/// region: a plane lies between them, and what reaches it is one convex face of either part, or one
/// face of the same outline of both. Most contacts of a model are of this kind. The plane is a
/// coordinate plane or, where oriented boxes are given, along one of theirs. Deviations up to a
/// twentieth of the reach do not count. False means not known.
[[nodiscard]] bool meet_in_one_planar_region(const PartWithObb& a, const PartWithObb& b,
                                             double reach);

}  // namespace strake::geometry
