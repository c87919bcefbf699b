// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "geometry/turned_part.hpp"

namespace strake::geometry {

/// Two parts in one frame, turned so that boxes along its axes fit.
struct AlignedParts {
  TurnedPart a, b;
};

/// Boxes along the axes tell nothing of needles that lie askew to them: facets of pipes, strips of
/// plates. Where many triangles of either part are needles that run one way, a frame with an axis
/// along them; nothing where there is no such way, or where it is an axis already. Both parts have
/// trees.
[[nodiscard]] std::optional<Axes> needle_axes(const PartView& a, const PartView& b);

/// Of one part alone.
[[nodiscard]] std::optional<Axes> needle_axes(const PartView& part);

/// The parts in such a frame, if there is one.
[[nodiscard]] std::optional<AlignedParts> aligned_parts(const PartView& a, const PartView& b,
                                                        const parallel::Context& context);

}  // namespace strake::geometry
