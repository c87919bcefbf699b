// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0042 says why fans are no boxes, and what equal objects hide.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hlr/occluders/occluder_polygons.hpp"
#include "hlr/view/view_bvh.hpp"

namespace strake::hlr {

/// Many polygons of a part round one point on paper. An edge passes under those alone whose angle
/// at the point holds some of the directions in which it is seen from there: boxes do not tell,
/// since all hold the point, and those of needles askew much of the others.
class PolygonFan {
 public:
  /// `numbers` of `polygons`, each with a corner at the point; orthographic.
  PolygonFan(const PaperCorner& at, std::vector<std::uint32_t> numbers,
             std::span<const OccluderPolygon> polygons, std::span<const PaperCorner> corners);

  /// Calls visit(number) -> bool for those that may hide the segment, which is part of the edge
  /// from `a` to `b`, until that returns false.
  template <class Visit>
  void traverse(const SegmentQuery& segment, const ViewPoint& a, const ViewPoint& b,
                Visit&& visit) const {
    const std::optional<SegmentQuery> seen = directions(a, b, segment.w0);
    if (!seen)
      return by_box_.traverse(segment, [&](std::uint32_t i) { return visit(numbers_[i]); });
    by_angle_.traverse(*seen, [&](std::uint32_t i) { return visit(numbers_[angles_[i]]); });
  }

 private:
  /// In which the edge is seen from the point; none where these are many or not known.
  [[nodiscard]] std::optional<SegmentQuery> directions(const ViewPoint& a, const ViewPoint& b,
                                                       double nearest) const;

  PaperCorner at_;
  std::vector<std::uint32_t> numbers_;
  ViewBvh by_box_;
  std::vector<std::uint32_t> angles_;  ///< by item of the tree: into the numbers
  ViewBvh by_angle_;                   ///< u: the angle, from 0 to kFullTurn
};

/// Takes the polygons round points where many meet out of the boxes, which are theirs, into fans.
/// `hubs`: such points, on paper; any of them may turn out to be none.
[[nodiscard]] std::vector<PolygonFan> extract_fans(std::vector<PaperCorner> hubs,
                                                   std::span<const OccluderPolygon> polygons,
                                                   std::span<const PaperCorner> corners,
                                                   std::vector<ViewBox>& boxes);

/// Polygons round a point from which on they make a fan.
inline constexpr std::size_t kLeastInFan = 64;

}  // namespace strake::hlr
