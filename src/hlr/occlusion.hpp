// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "hlr/param.hpp"
#include "hlr/shape_view.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::hlr {

/// Grid units, in the measure of a contact distance: an edge of a part whose ends are no deeper
/// than this under the plane of one of its faces lies in that plane, as both were rounded.
inline constexpr std::int64_t kLyingInPlane = 2;

enum Side : std::uint8_t { kLeft = 1, kRight = 2, kBothSides = 3 };

/// A stretch of an edge that something hides, on one side of the edge or on both.
struct Hit {
  Param lo, hi;
  std::uint8_t sides = 0;
  bool self = false;
};

/// An edge in the coordinates of the shape that may hide it.
struct LocalEdge {
  geometry::Vec3l a, b;
  ViewPoint va, vb;                         ///< orthographic
  ViewBox box;                              ///< on paper, of what is drawn of it
  std::int64_t nearest = 0;                 ///< of its ends the greater product with the direction
  const geometry::Box3l* limits = nullptr;  ///< in the same coordinates; null where none cut
  bool narrow = false;  ///< 64-bit integers suffice for orientations of this edge and shape
};

/// True when orientations of points within ±reach can be formed in 64 bits.
[[nodiscard]] constexpr bool fits_narrow(std::int64_t reach) {
  return reach < (std::int64_t{1} << 29);
}

/// The closed stretch of the edge that a polygon hides, by the two-sided rule: what lies strictly
/// under its open inside for points a hair left or right of the edge, deeper than `contact` in
/// the sense of docs/hlr.md. An edge of which neither end is deeper than `lying` lies in the
/// polygon's plane: nothing. Exact. The caller has found that may_hide(edge, polygon.box).
[[nodiscard]] std::optional<Hit> hidden_stretch(const LocalEdge& edge, const ShapeView& shape,
                                                const Polygon& polygon, std::int64_t contact,
                                                std::int64_t lying);

/// The same for what lies deep under an outline (PartView::outline), planes apart.
[[nodiscard]] std::optional<Hit> outlined_stretch(const LocalEdge& edge, const ShapeView& shape,
                                                  const Polygon& outline);

/// False when the boxes alone show that nothing in `box` hides any of the edge.
[[nodiscard]] inline bool may_hide(const LocalEdge& e, const ViewBox& box) {
  return e.box.hi.u >= box.lo.u && e.box.lo.u <= box.hi.u && e.box.hi.v >= box.lo.v &&
         e.box.lo.v <= box.hi.v && e.box.lo.w < box.hi.w;
}

}  // namespace strake::hlr
