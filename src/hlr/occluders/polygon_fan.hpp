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

/// Many polygons of a part round one point on paper. An edge can pass only under those whose angle
/// at the point holds some of the directions in which the edge is seen from there. Boxes do not
/// separate them: all hold the point, and boxes of needles askew much of the others.
class PolygonFan {
 public:
  /// Makes a fan of the `numbers` of `polygons`, each with a corner at the point; orthographic.
  PolygonFan(const PaperCorner& at, std::vector<std::uint32_t> numbers,
             std::span<const OccluderPolygon> polygons, std::span<const PaperCorner> corners);

  /// Calls visit(number) -> bool for the polygons that may hide the segment, which is part of the
  /// edge from `a` to `b`, until that returns false.
  template <class Visit>
  void traverse(const SegmentQuery& segment, const ViewPoint& a, const ViewPoint& b,
                Visit&& visit) const {
    const std::optional<SegmentQuery> range = directions(a, b, segment.w0);
    if (!range)
      return by_box_.traverse(segment, [&](std::uint32_t i) { return visit(numbers_[i]); });
    by_angle_.traverse(*range, [&](std::uint32_t i) { return visit(numbers_[angles_[i]]); });
  }

 private:
  /// Returns the directions in which the edge is seen from the point; none where they are many or
  /// unknown.
  [[nodiscard]] std::optional<SegmentQuery> directions(const ViewPoint& a, const ViewPoint& b,
                                                       double nearest) const;

  PaperCorner at_;
  std::vector<std::uint32_t> numbers_;
  ViewBvh by_box_;
  std::vector<std::uint32_t> angles_;  ///< by item of by_angle_: index into numbers_
  ViewBvh by_angle_;                   ///< u: the angle, from 0 to kFullTurn
};

/// Makes fans of the polygons round points where many meet, and empties their boxes. `hubs`:
/// candidates for such points, on paper.
[[nodiscard]] std::vector<PolygonFan> extract_fans(std::vector<PaperCorner> hubs,
                                                   std::span<const OccluderPolygon> polygons,
                                                   std::span<const PaperCorner> corners,
                                                   std::vector<ViewBox>& boxes);

/// The least number of polygons round a point that make a fan. 12,500 creases from one point take
/// 0.3 s with fans, and took 10 without (decision 0042, bench hlr_growth).
inline constexpr std::size_t kMinInFan = 64;

}  // namespace strake::hlr
