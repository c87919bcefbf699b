// SPDX-License-Identifier: Apache-2.0
#include "hlr/view/view_bvh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace strake::hlr {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::int64_t kExact = std::int64_t{1} << 53;

double below(std::int64_t x) {
  const auto d = static_cast<double>(x);
  return x >= -kExact && x <= kExact ? d : std::nextafter(d, -kInfinity);
}
double above(std::int64_t x) {
  const auto d = static_cast<double>(x);
  return x >= -kExact && x <= kExact ? d : std::nextafter(d, kInfinity);
}

struct Task {
  std::uint32_t node = 0, first = 0, last = 0;
};

}  // namespace

LooseBox rounded_outwards(const ViewBox& box) {
  return {below(box.lo.u), above(box.hi.u), below(box.lo.v), above(box.hi.v), above(box.hi.w)};
}

SegmentQuery anything_in(const ViewBox& box) {
  constexpr double kRoundingShare =
      1e-12;  // of the depth, far above what rounding to a double takes
  const LooseBox loose = rounded_outwards(box);
  SegmentQuery query;
  query.u0 = loose.u0;
  query.u1 = loose.u1;
  query.v0 = loose.v0;
  query.v1 = loose.v1;
  const auto deepest = static_cast<double>(box.lo.w);
  query.w0 = deepest - kRoundingShare * std::abs(deepest);
  return query;
}

// Median splits of the longer side on paper: depth is at most log2(n), so the stack of
// traverse_boxes() suffices.
ViewBvh::ViewBvh(std::span<const ViewBox> boxes, std::uint32_t leaf_size) {
  std::vector<LooseBox> loose(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    if (boxes[i].empty()) continue;
    loose[i] = rounded_outwards(boxes[i]);
    order_.push_back(i);
  }
  if (order_.empty()) return;
  nodes_.reserve(2 * order_.size() / leaf_size + 2);
  nodes_.emplace_back();
  std::vector<Task> tasks{{0, 0, static_cast<std::uint32_t>(order_.size())}};
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    LooseBox box = loose[order_[task.first]];
    double u0 = kInfinity, u1 = -kInfinity, v0 = kInfinity, v1 = -kInfinity;
    for (std::uint32_t i = task.first; i < task.last; ++i) {
      const LooseBox& b = loose[order_[i]];
      box = {std::min(box.u0, b.u0), std::max(box.u1, b.u1), std::min(box.v0, b.v0),
             std::max(box.v1, b.v1), std::max(box.w1, b.w1)};
      u0 = std::min(u0, b.u0 + b.u1);
      u1 = std::max(u1, b.u0 + b.u1);
      v0 = std::min(v0, b.v0 + b.v1);
      v1 = std::max(v1, b.v0 + b.v1);
    }
    nodes_[task.node].box = box;
    if (task.last - task.first <= leaf_size) {
      nodes_[task.node].first = task.first;
      nodes_[task.node].count = task.last - task.first;
      continue;
    }
    const std::uint32_t middle = task.first + (task.last - task.first) / 2;
    const bool by_u = u1 - u0 >= v1 - v0;
    const auto key = [&](std::uint32_t i) {
      return by_u ? loose[i].u0 + loose[i].u1 : loose[i].v0 + loose[i].v1;
    };
    std::nth_element(order_.begin() + task.first, order_.begin() + middle,
                     order_.begin() + task.last, [&](std::uint32_t x, std::uint32_t y) {
                       return key(x) < key(y) || (key(x) == key(y) && x < y);
                     });
    const auto child = static_cast<std::uint32_t>(nodes_.size());
    nodes_[task.node].first = child;
    nodes_.emplace_back();
    nodes_.emplace_back();
    tasks.push_back({child, task.first, middle});
    tasks.push_back({child + 1, middle, task.last});
  }
  boxes_.reserve(order_.size());
  for (const std::uint32_t i : order_) boxes_.push_back(loose[i]);
}

}  // namespace strake::hlr
