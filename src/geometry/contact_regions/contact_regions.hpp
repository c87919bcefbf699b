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

/// One of the places where two parts meet or come near. Coordinates are grid units relative to the
/// first part's origin.
struct ContactRegion {
  Box3d extent = empty_box<double>();  ///< holds the place
  /// The nearest points of the two skins there; distance 0 where they meet.
  ClosestPair nearest;
  double least = 0;  ///< a certain lower bound on that distance
};

/// What is asked about a place that turns out to be the only one.
enum class SingleRegionDetail : std::uint8_t {
  counted,    ///< nothing: the list has one empty entry
  boxed,      ///< its extent, of the skins alone
  described,  ///< everything
};

struct ContactRegionOptions {
  double reach = 0;             ///< how near is near, grid units
  double distance = 0;          ///< of the two, where known: tells only how best to go about it
  bool interiors_meet = false;  ///< as meet() found
  SingleRegionDetail one = SingleRegionDetail::described;
  std::uint64_t most_pairs = std::uint64_t{1} << 22U;  ///< of near triangles, before it is given up
};

/// The separate places where two parts come within a reach of each other: the connected components
/// of the set of pairs of points, one of each body, no farther apart than the reach. With reach 0
/// these are the connected components of what the bodies have in common. For a solid the body is
/// its volume, so that a pipe through a wall is one place and not two; for a sheet its surface.
///
/// The set of pairs of points of two skins is the union, over pairs of triangles, of convex sets
/// that overlap exactly where a triangle of the one comes within reach of an edge of a triangle of
/// the other. So the pairs of triangles are joined over their edges; and, where interiors meet,
/// along the stretches of edges, and of lines across faces, that run through the other's inside.
///
/// Distances are compared in double arithmetic and sides a 4096th of a grid unit off the line, so
/// places within a grid unit of being one may be either. Not joined: two skins of one body (its
/// outside and a cavity) between which only its material lies. Nothing where there are more pairs
/// of near triangles than asked for, or where some triangles, once a walk over them has turned out
/// heavy, show that there are about twice as many; an empty list where no skins are near: one body
/// far inside the other.
[[nodiscard]] std::optional<std::vector<ContactRegion>> contact_regions(
    const PartWithBvh& a, const PartWithBvh& b, const ContactRegionOptions& question,
    QueryContext& work);

/// A spot of a skin.
struct ContactSurfacePoint {
  bool of_a = true;            ///< whose skin
  std::uint32_t triangle = 0;  ///< its triangle there
  Vec3d point;                 ///< grid units relative to a's origin
};

/// The same with a way to tell places apart that lie in each other's boxes.
struct ContactRegions {
  std::vector<ContactRegion> all;
  /// The number of the place that a spot of one skin, in the other body or near its skin, belongs
  /// to; none where that is not known. The parts and their trees must live.
  std::function<std::optional<std::uint32_t>(const ContactSurfacePoint&)> region_of;
  /// Likewise for a triangle of a and one of b within reach of each other.
  std::function<std::optional<std::uint32_t>(std::uint32_t, std::uint32_t)> region_of_pair;
};
[[nodiscard]] std::optional<ContactRegions> find_contact_regions(
    const PartWithBvh& a, const PartWithBvh& b, const ContactRegionOptions& question,
    QueryContext& work);

/// A box that holds all that two parts have in common, and where their skins come within reach of
/// each other, relative to a's origin: what of either skin lies in the box along the other's faces.
/// Both have frames; they do come within reach.
[[nodiscard]] Box3d overlap_extent(const PartWithObb& a, const PartWithObb& b, double reach);

/// Whether it is certain, from flat faces alone, that two parts that come within reach of each
/// other do so in one place: a plane lies between them, and what of either reaches it is one convex
/// face, or of both one face of the same outline. Most contacts of a model are of this kind. The
/// plane is a coordinate plane or, where frames are given, along one of theirs. What a twentieth of
/// the reach could make of it does not count. False says nothing.
[[nodiscard]] bool meet_in_one_planar_region(const PartWithObb& a, const PartWithObb& b,
                                             double reach);

}  // namespace strake::geometry
