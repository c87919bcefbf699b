// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "strake/geometry/grid_shapes.hpp"
#include "strake/geometry/mesh.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// A cutting plane: points on the plane normal·p = offset or on the side that the normal points to
/// are cut away. A body keeps the closure of its points strictly on the other side. So a face in
/// the plane is cut as if the plane were infinitesimally lower, and a body standing on the plane is
/// removed as a whole.
///
/// |component| <= 2^20, |offset| <= 2^54.
struct CutPlane {
  Vec3l normal;
  std::int64_t offset = 0;

  /// Returns the height of a point within ±2^31; below zero it is kept.
  [[nodiscard]] constexpr std::int64_t height(const Vec3l& p) const {
    return dot(normal, p) - offset;
  }
  friend constexpr bool operator==(const CutPlane&, const CutPlane&) = default;
};

/// Returns what planes leave of a segment, its ends in the order given; nothing where all is cut
/// away or the rest shrinks to a point. Each plane rounds the new end to the grid, by half a unit
/// at most along each axis.
[[nodiscard]] std::optional<Segment> left_of(const Segment& segment,
                                             std::span<const CutPlane> planes);

/// A line in which a plane cuts a part.
struct SectionLine {
  Segment at{};  ///< ascending
  std::uint32_t plane = 0;

  friend auto operator<=>(const SectionLine&, const SectionLine&) = default;
};

/// The part that planes, one after the other, leave.
struct PartSection {
  /// Closed by caps where the part is a solid; no triangles and no chains where nothing is left.
  /// Source faces and the primitive are not kept.
  Part part;
  /// By triangle: the plane whose cap it belongs to, kNoIndex for the rest. Empty where nothing was
  /// cut.
  std::vector<std::uint32_t> cap_of;
  /// The section lines, sorted and without duplicates. Segments that share two planes are one,
  /// however the faces are triangulated.
  std::vector<SectionLine> lines;
  /// Number of planes that made vertices which had to be rounded to the grid.
  std::uint32_t rounded = 0;
  /// Numbers of line ends of a sheet that no other line continues, and of sections of a solid that
  /// could not be filled: they are not closed, or too crooked on the grid.
  std::uint32_t open_ends = 0, not_filled = 0;
};

/// Cuts a part in its own coordinates. Which triangles are cut where is decided exactly; a new
/// vertex is the exact one, rounded to the grid. A section of a solid is filled where its winding
/// number is not zero, by a constrained Delaunay triangulation of its outline; lines that cross on
/// the plane are cut at the point, rounded.
[[nodiscard]] PartSection cut(const Part& part, std::span<const CutPlane> planes);

/// Returns the oriented boundary of a plane's caps: the material lies on the left of each segment,
/// seen from where the normal points to. Sorted; the loops may be nested but do not cross.
[[nodiscard]] std::vector<Segment> cap_boundary(const PartSection& cut, std::uint32_t plane);

/// A plane projected along the axis most nearly perpendicular to it: coordinates `u` and `v` of a
/// point run counter-clockwise seen from where the normal points to.
struct PlaneAxes {
  int u = 0, v = 1, w = 2;

  explicit constexpr PlaneAxes(const Vec3l& normal) {
    const auto size = [&](int k) { return normal[k] < 0 ? -normal[k] : normal[k]; };
    for (const int k : {1, 0})
      if (size(k) > size(w)) w = k;
    u = (w + 1) % 3;
    v = (w + 2) % 3;
    if (normal[w] < 0) {
      const int other = u;
      u = v;
      v = other;
    }
  }
};

}  // namespace strake::geometry
