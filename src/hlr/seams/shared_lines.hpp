// SPDX-License-Identifier: Apache-2.0
// Edges of different parts that lie on each other.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <vector>

#include "hlr/prepare/view_job.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/grid_shapes.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/wide_int.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// A part with faces of a body that is drawn.
struct SeamSurface {
  geometry::PlacedPart placed;
  std::uint32_t body = 0, part = 0;  ///< its body, and its number among the parts of the shape
  std::int64_t contact = 0;          ///< contact distance, grid units
};

/// The parts with faces of all bodies that are drawn and not cut away wholly, by body and part, as
/// they are before sections cut them.
[[nodiscard]] std::vector<SeamSurface> seam_surfaces(const ViewJob& job);

/// Returns an edge of a part in the coordinates of the scene, its lesser end first.
[[nodiscard]] geometry::Segment edge_line(const geometry::PlacedPart& placed, std::uint32_t edge);

/// The ways from the first end of a line along it, as products with its direction: 0 to `length`,
/// the square of its length.
struct LineMeasure {
  geometry::Segment line;
  geometry::Int128 length = 0;

  explicit LineMeasure(const geometry::Segment& of);
  [[nodiscard]] geometry::Int128 along(const geometry::Vec3l& point) const;
  /// Returns the grid point nearest to a place on the line.
  [[nodiscard]] geometry::Vec3l at(geometry::Int128 place) const;
  /// Returns how much of that measure a distance takes at least: distance·|direction|₁.
  [[nodiscard]] geometry::Int128 room(std::int64_t distance) const;
  /// Returns whether a point is no farther off the straight line than `distance`, for each
  /// component of its moment: |direction x (point - end)| <= distance·|direction|₁.
  [[nodiscard]] bool passes(const geometry::Vec3l& point, std::int64_t distance) const;
};

/// An interval of an edge of one part on which an edge of another lies.
struct SharedLine {
  std::uint32_t surface = 0, edge = 0;  ///< whose interval it is
  geometry::Int128 from = 0, to = 0;    ///< by LineMeasure of that edge
  std::uint32_t other = 0, along = 0;   ///< the other part, and its edge
  std::int64_t contact = 0;             ///< the larger contact distance of the two

  friend auto operator<=>(const SharedLine&, const SharedLine&) = default;
};

/// Returns the intervals, ascending, each for both of its edges; only of parts of bodies of one
/// colour and category, and only as far as sections leave the other part.
///
/// Edges between triangles of one face are none. Two edges lie on each other where both ends of the
/// shorter one pass the line of the longer one within the larger contact distance of their bodies;
/// intervals that end within it of an end of the edge reach that end. Errors: cancelled, too many
/// boxes that meet (input).
[[nodiscard]] Result<std::vector<SharedLine>> find_shared_lines(
    const ViewJob& job, const std::vector<SeamSurface>& surfaces, const parallel::Context& context);

}  // namespace strake::hlr
