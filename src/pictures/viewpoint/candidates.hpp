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

/// Returns how much people prefer to look in a direction, 0 to 1: from above and askew most.
[[nodiscard]] double direction_preference(const geometry::Vec3d& viewer);

/// Returns the score of a share, 0 to 1: showing more of what is well seen adds little.
[[nodiscard]] double share_score(double share);

/// A direction to the viewer, and what it shows.
struct ViewCandidate {
  geometry::Vec3d viewer;
  double share = 0;
  double rank = 0;  ///< share_score() times direction_preference()
};

/// Returns what each direction shows, in their order. Errors: cancelled.
[[nodiscard]] Result<std::vector<ViewCandidate>> evaluate_candidates(
    const NearTriangles& triangles, std::span<const geometry::Vec3d> directions, const Sight& sight,
    const parallel::Context& context);

/// The best of some directions.
struct BestCandidates {
  ViewCandidate best;
  ViewCandidate alone;  ///< the best where nothing else stood in the way
};

/// Returns what best_of(evaluate_candidates()) returns, without evaluating directions that cannot
/// be the best even if nothing else stood in the way. There must be one. Errors: cancelled.
[[nodiscard]] Result<BestCandidates> find_best(const NearTriangles& triangles,
                                               std::span<const geometry::Vec3d> directions,
                                               const Sight& sight,
                                               const parallel::Context& context);

/// Returns the candidate of the highest rank, of equals the first; there must be one.
[[nodiscard]] const ViewCandidate& best_of(std::span<const ViewCandidate> candidates);

}  // namespace strake::pictures
