// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "geometry/pair_view.hpp"
#include "strake/geometry/part_tree.hpp"

namespace strake::geometry {

/// Unit vectors square to each other, but for rounding.
using Axes = std::array<Vec3d, 3>;

/// The coordinates of a point in a frame of such axes with the same origin.
[[nodiscard]] inline Vec3d turned(const Axes& axes, const Vec3d& p) {
  return {dot(axes[0], p), dot(axes[1], p), dot(axes[2], p)};
}

/// A part's triangles with corners in another frame, and a tree over them. Each corner is off by
/// less than kTurnRounding in all.
struct TurnedPart {
  Part part;  ///< vertices and triangles only
  PartTree tree;
};

/// A part and the frame that it is turned into.
struct TurnedFrame {
  Axes axes;
  TurnedPart part;
};

/// Turning a corner and rounding it takes it up to half a unit along each axis, half the root of
/// three in all, and some rounding of doubles away.
inline constexpr double kTurnRounding = 1;

/// Grid units: what coordinates along turned axes may be off by, far above their rounding.
inline constexpr double kFrameRounding = 0x1p-10;

/// Over the triangles of a view's own tree; nothing where the part is too large to be turned.
[[nodiscard]] std::optional<TurnedPart> turned_part(const PartView& view, const Axes& axes,
                                                    const parallel::Context& context);

}  // namespace strake::geometry
