// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "geometry/bvh/pair_local_part.hpp"
#include "strake/geometry/triangle_bvh.hpp"

// Parts in rotated frames, and frames along the slivers of parts.

namespace strake::geometry {

/// Unit vectors, perpendicular to each other but for rounding.
using Axes = std::array<Vec3d, 3>;

/// Returns the coordinates of a point in a frame of such axes with the same origin.
[[nodiscard]] inline Vec3d turned(const Axes& axes, const Vec3d& p) {
  return {dot(axes[0], p), dot(axes[1], p), dot(axes[2], p)};
}

/// A part's triangles with vertices in another frame, and a tree over them. Each vertex is off by
/// less than kRotationRounding in all.
struct RotatedPart {
  Part part;  ///< vertices and triangles only
  TriangleBvh tree;
};

/// A part and the frame that it is rotated into.
struct RotatedFrame {
  Axes axes;
  RotatedPart part;
};

/// Grid units: rotating a vertex and rounding it moves it by up to half a unit along each axis,
/// half the root of three in all, plus some rounding of doubles.
inline constexpr double kRotationRounding = 1;

/// Grid units: error bound of coordinates along rotated axes, far above their rounding.
inline constexpr double kFrameRounding = 0x1p-10;

/// Rotates the triangles of a view's own tree; nothing where the part is too large to be rotated.
[[nodiscard]] std::optional<RotatedPart> rotate_part(const PairLocalPart& view, const Axes& axes,
                                                     const parallel::Context& context);

/// Two parts in one frame, rotated so that boxes along its axes are tight.
struct RotatedParts {
  RotatedPart a, b;
};

/// Returns a frame with an axis along the slivers of two parts, where many triangles of either are
/// slivers in one direction: boxes along the coordinate axes are useless for rotated slivers, as
/// the facets of pipes and the strips of plates. Nothing where there is no such direction, or where
/// it is an axis already. Both parts have trees.
[[nodiscard]] std::optional<Axes> sliver_axes(const PairLocalPart& a, const PairLocalPart& b);

/// Returns such a frame for one part alone.
[[nodiscard]] std::optional<Axes> sliver_axes(const PairLocalPart& part);

/// Returns the parts in such a frame, if there is one.
[[nodiscard]] std::optional<RotatedParts> rotate_along_slivers(const PairLocalPart& a,
                                                               const PairLocalPart& b,
                                                               const parallel::Context& context);

}  // namespace strake::geometry
