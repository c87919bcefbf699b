// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hlr/polygon.hpp"
#include "hlr/view_tree.hpp"

namespace strake::hlr {

/// Many polygons of a part round one point on paper. An edge passes under those alone whose angle
/// at the point holds some of the directions in which it is seen from there: boxes do not tell,
/// since all hold the point, and those of needles askew much of the others.
class Fan {
 public:
  /// `numbers` of `polygons`, each with a corner at the point; orthographic.
  Fan(const Corner& at, std::vector<std::uint32_t> numbers, std::span<const Polygon> polygons,
      std::span<const Corner> corners);

  /// Calls visit(number) -> bool for those that may hide the segment, which is part of the edge
  /// from `a` to `b`, until that returns false.
  template <class Visit>
  void walk(const LooseSegment& segment, const ViewPoint& a, const ViewPoint& b,
            Visit&& visit) const {
    const std::optional<LooseSegment> seen = directions(a, b, segment.w0);
    if (!seen) return by_box_.walk(segment, [&](std::uint32_t i) { return visit(numbers_[i]); });
    by_angle_.walk(*seen, [&](std::uint32_t i) { return visit(numbers_[angles_[i]]); });
  }

 private:
  /// In which the edge is seen from the point; none where these are many or not known.
  [[nodiscard]] std::optional<LooseSegment> directions(const ViewPoint& a, const ViewPoint& b,
                                                       double nearest) const;

  Corner at_;
  std::vector<std::uint32_t> numbers_;
  ViewTree by_box_;
  std::vector<std::uint32_t> angles_;  ///< by item of the tree: into the numbers
  ViewTree by_angle_;                  ///< u: the angle, from 0 to kFullTurn
};

/// Takes the polygons round points where many meet out of the boxes, which are theirs, into fans.
/// `hubs`: such points, on paper; any of them may turn out to be none.
[[nodiscard]] std::vector<Fan> take_fans(std::vector<Corner> hubs,
                                         std::span<const Polygon> polygons,
                                         std::span<const Corner> corners,
                                         std::vector<ViewBox>& boxes);

/// Polygons round a point from which on they make a fan.
inline constexpr std::size_t kLeastInFan = 64;

}  // namespace strake::hlr
