// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "pictures/scenery/surroundings.hpp"
#include "pictures/viewpoint/camera.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/parallel/context.hpp"

// Decision 0083 says why these directions, and this measure.

namespace strake::pictures {

/// Returns the directions to viewers that are tried: those along the axes, of edges and corners a
/// little askew so that no two faces fall together, and about a direction that pushes the two
/// apart, which is square to the faces that meet.
[[nodiscard]] std::vector<geometry::Vec3d> candidate_directions(const geometry::Vec3d& away);

/// How what is near a clash is looked at; lengths from the point of the clash.
struct Sight {
  double half_mm = 1;     ///< half of the window's side, which is square
  double eye_mm = 1e300;  ///< how far away the eye is
  double cut_mm = 1e300;  ///< what lies nearer to the viewer than this is cut away
};

/// Returns how well the two objects are seen in a direction, 0 to 1: the harmonic mean of their
/// shares of the window, less where neither shows at the point of the clash.
[[nodiscard]] double visible_share(const NearTriangles& triangles, const geometry::Vec3d& viewer,
                                   const Sight& sight);

/// Returns how people like to look in a direction, 0 to 1: from above and askew best.
[[nodiscard]] double liking(const geometry::Vec3d& viewer);

/// Returns what a share is worth, 0 to 1: of what is well seen more is worth little.
[[nodiscard]] double worth(double share);

/// A direction to the viewer, and what it shows.
struct Candidate {
  geometry::Vec3d viewer;
  double share = 0;
  double rank = 0;  ///< what the share is worth, times the liking
};

/// Returns all candidates in their order. Errors: cancelled.
[[nodiscard]] Result<std::vector<Candidate>> judge(const NearTriangles& triangles,
                                                   std::span<const geometry::Vec3d> directions,
                                                   const Sight& sight,
                                                   const parallel::Context& context);

/// The best of some directions.
struct Found {
  Candidate best;
  Candidate alone;  ///< the best where nothing else stood in the way
};

/// Returns what best_of(judge()) returns, without a look at directions that cannot be the best even
/// if nothing else stood in the way. There must be one. Errors: cancelled.
[[nodiscard]] Result<Found> find_best(const NearTriangles& triangles,
                                      std::span<const geometry::Vec3d> directions,
                                      const Sight& sight, const parallel::Context& context);

/// Returns the candidate of the highest rank, of equals the first; there must be one.
[[nodiscard]] const Candidate& best_of(std::span<const Candidate> candidates);

}  // namespace strake::pictures
