// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "geometry/pair_view.hpp"
#include "strake/geometry/part_tree.hpp"

namespace strake::geometry {

/// A part's triangles with corners in another frame, and a tree over them. Each corner is off by
/// less than kTurnRounding along each axis.
struct TurnedPart {
  Part part;  ///< vertices and triangles only
  PartTree tree;
};

/// Two parts in one frame, turned so that boxes along its axes fit.
struct AlignedParts {
  TurnedPart a, b;
};

/// Turning a corner and rounding it takes it up to half a unit and some rounding of doubles away.
inline constexpr double kTurnRounding = 1;

/// Boxes along the axes tell nothing of needles that lie askew to them: facets of pipes, strips of
/// plates. Where many triangles of either part are needles that run one way, the parts in a frame
/// with an axis along them; nothing where there is no such way, or where it is an axis already.
[[nodiscard]] std::optional<AlignedParts> aligned_parts(const PartView& a, const PartView& b,
                                                        const parallel::Context& context);

}  // namespace strake::geometry
