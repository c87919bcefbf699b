// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "geometry/bvh/pair_local_part.hpp"
#include "strake/geometry/triangle_bvh.hpp"

namespace strake::geometry {

/// Unit vectors square to each other, but for rounding.
using Axes = std::array<Vec3d, 3>;

/// The coordinates of a point in a frame of such axes with the same origin.
[[nodiscard]] inline Vec3d turned(const Axes& axes, const Vec3d& p) {
  return {dot(axes[0], p), dot(axes[1], p), dot(axes[2], p)};
}

/// A part's triangles with corners in another frame, and a tree over them. Each corner is off by
/// less than kRotationRounding in all.
struct RotatedPart {
  Part part;  ///< vertices and triangles only
  TriangleBvh tree;
};

/// A part and the frame that it is turned into.
struct RotatedFrame {
  Axes axes;
  RotatedPart part;
};

/// Turning a corner and rounding it takes it up to half a unit along each axis, half the root of
/// three in all, and some rounding of doubles away.
inline constexpr double kRotationRounding = 1;

/// Grid units: what coordinates along turned axes may be off by, far above their rounding.
inline constexpr double kFrameRounding = 0x1p-10;

/// Over the triangles of a view's own tree; nothing where the part is too large to be turned.
[[nodiscard]] std::optional<RotatedPart> rotate_part(const PairLocalPart& view, const Axes& axes,
                                                     const parallel::Context& context);

/// Two parts in one frame, turned so that boxes along its axes fit.
struct RotatedParts {
  RotatedPart a, b;
};

/// Boxes along the axes tell nothing of needles that lie askew to them: facets of pipes, strips of
/// plates. Where many triangles of either part are needles that run one way, a frame with an axis
/// along them; nothing where there is no such way, or where it is an axis already. Both parts have
/// trees.
[[nodiscard]] std::optional<Axes> sliver_axes(const PairLocalPart& a, const PairLocalPart& b);

/// Of one part alone.
[[nodiscard]] std::optional<Axes> sliver_axes(const PairLocalPart& part);

/// The parts in such a frame, if there is one.
[[nodiscard]] std::optional<RotatedParts> rotate_along_slivers(const PairLocalPart& a,
                                                               const PairLocalPart& b,
                                                               const parallel::Context& context);

}  // namespace strake::geometry
