// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hlr/view/projection.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// A view box in doubles, rounded outwards.
struct LooseBox {
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
  double w1 = 0;  ///< the greatest w of anything in the box, towards the viewer
};

[[nodiscard]] LooseBox rounded_outwards(const ViewBox& box);

/// A query for what may hide part of an edge.
struct SegmentQuery {
  double au = 0, av = 0, du = 0, dv = 0;          ///< the line: a point and its direction
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0, w0 = 0;  ///< box of the queried part
  double beside = 0;  ///< tolerance at the line where it is known roughly: an area

  /// Returns false only when the box cannot hold anything that hides a point of the segment.
  [[nodiscard]] bool may_be_hidden_by(const LooseBox& b) const {
    if (b.u1 < u0 || b.u0 > u1 || b.v1 < v0 || b.v0 > v1 || b.w1 <= w0) return false;
    const double hu = (b.u1 - b.u0) * 0.5, hv = (b.v1 - b.v0) * 0.5;
    const double cu = b.u0 + hu - au, cv = b.v0 + hv - av;
    const double p = du * cv, q = dv * cu;
    const double reach = (du < 0 ? -du : du) * hv + (dv < 0 ? -dv : dv) * hu;
    const double slack = ((p < 0 ? -p : p) + (q < 0 ? -q : q) + reach) * 1e-12;
    const double off = p - q;
    return (off < 0 ? -off : off) <= reach + slack + beside;
  }
};

/// Returns a query for what may hide anything in a box.
[[nodiscard]] SegmentQuery anything_in(const ViewBox& box);

/// Coordinates on paper up to this one are doubles exactly, and so are their differences.
inline constexpr std::int64_t kExactInDouble = std::int64_t{1} << 52;

/// Returns a query for what may hide that part of the segment from a to b which lies in the box.
/// Where coordinates are too large for doubles to have its line, the box alone decides.
[[nodiscard]] SegmentQuery on_segment(const ViewPoint& a, const ViewPoint& b, const ViewBox& box);

/// A bounding-volume hierarchy over view boxes, traversed front to back where that has a meaning.
class ViewBvh {
 public:
  struct Node {
    LooseBox box;
    std::uint32_t first = 0;  ///< inner: left child (right = left + 1); leaf: first of order()
    std::uint32_t count = 0;  ///< 0: inner
  };

  ViewBvh() = default;
  /// Builds the hierarchy. Empty boxes are left out.
  explicit ViewBvh(std::span<const ViewBox> boxes);

  /// Builds the same hierarchy by all workers.
  /// Errors: cancelled, out_of_memory.
  [[nodiscard]] static Result<ViewBvh> of(std::span<const ViewBox> boxes,
                                          const parallel::Context& context);

  [[nodiscard]] bool empty() const { return nodes_.empty(); }
  [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }

  /// Calls visit(index) -> bool for every item whose box may hide the segment, nearer nodes first;
  /// visit may shrink the segment, and ends the traversal by returning false.
  template <class Visit>
  void traverse(const SegmentQuery& segment, Visit&& visit) const {
    traverse_boxes(segment, [&](std::uint32_t i, const LooseBox&) { return visit(i); });
  }
  /// Traverses likewise with visit(index, box) -> bool.
  template <class Visit>
  void traverse_boxes(const SegmentQuery& segment, Visit&& visit) const {
    if (nodes_.empty()) return;
    std::uint32_t stack[64];
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const Node& node = nodes_[stack[--top]];
      if (!segment.may_be_hidden_by(node.box)) continue;
      if (node.count > 0) {
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
          if (segment.may_be_hidden_by(boxes_[i]) && !visit(order_[i], boxes_[i])) return;
        continue;
      }
      const bool left_nearer = nodes_[node.first].box.w1 >= nodes_[node.first + 1].box.w1;
      stack[top++] = node.first + (left_nearer ? 1 : 0);
      stack[top++] = node.first + (left_nearer ? 0 : 1);
    }
  }

 private:
  class Builder;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
  std::vector<LooseBox> boxes_;  ///< in the order of order_, so that rejected items are not fetched
};

}  // namespace strake::hlr
