// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "hlr/view/view_bvh.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::hlr {

/// Ends of lines are rounded to the grid: so far a line may reach beyond the boxes that it is of.
inline constexpr std::int64_t kRounded = 2;

/// Boxes of the model in a tree.
class SolidBoxes {
 public:
  explicit SolidBoxes(std::vector<geometry::Box3l> boxes) : boxes_(std::move(boxes)) {
    std::vector<ViewBox> in_tree;
    in_tree.reserve(boxes_.size());
    for (const geometry::Box3l& box : boxes_)
      in_tree.push_back(box.empty() ? ViewBox() : as_view_box(box));
    tree_ = ViewBvh(in_tree);
  }

  /// Calls visit(index) -> bool for the boxes that meet one, until it returns false. Boxes that
  /// only touch each other from below need not be found: what they hold does not cross.
  template <class Visit>
  void for_each_that_meets(const geometry::Box3l& box, Visit&& visit) const {
    if (box.empty()) return;
    tree_.traverse(anything_in(as_view_box(box)),
                   [&](std::uint32_t i) { return !boxes_[i].meets(box) || visit(i); });
  }
  [[nodiscard]] bool any_meets(const geometry::Box3l& box) const {
    bool any = false;
    for_each_that_meets(box, [&](std::uint32_t) {
      any = true;
      return false;
    });
    return any;
  }

 private:
  static ViewBox as_view_box(const geometry::Box3l& box) {
    return {{box.lo.x, box.lo.y, box.lo.z}, {box.hi.x, box.hi.y, box.hi.z}};
  }

  std::vector<geometry::Box3l> boxes_;
  ViewBvh tree_;
};

}  // namespace strake::hlr
