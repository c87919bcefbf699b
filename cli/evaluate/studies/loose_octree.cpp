// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/studies/loose_octree.hpp"

#include <algorithm>
#include <bit>

#include "cli/evaluate/studies/object_boxes.hpp"

namespace strake::cli {

namespace {

using geometry::Box3l;
using geometry::Vec3l;

/// A cell has a side of 2^10 grid units, about a millimetre, at least.
constexpr int kLogFinest = 10;

std::int64_t longest_side(const Box3l& box) {
  const Vec3l size = box.hi - box.lo;
  return std::max({size.x, size.y, size.z});
}

/// Returns the logarithm of the least power of two that is no shorter than a length.
int log_size_of(std::int64_t length) {
  const auto bits = static_cast<std::uint64_t>(std::max<std::int64_t>(length - 1, 0));
  return std::max(static_cast<int>(std::bit_width(bits)), kLogFinest);
}

Vec3l middle_of(const Box3l& box) {
  Vec3l middle;
  for (int k = 0; k < 3; ++k) middle[k] = box.lo[k] + (box.hi[k] - box.lo[k]) / 2;
  return middle;
}

}  // namespace

Box3l LooseOctree::Cell::loose_box() const {
  const std::int64_t size = std::int64_t{1} << log_size;
  return Box3l{lo, {lo.x + size, lo.y + size, lo.z + size}}.inflated(size / 2);
}

LooseOctree::LooseOctree(std::span<const Box3l> boxes) : boxes_(boxes), next_(boxes.size(), kNone) {
  Box3l all = geometry::empty_box<std::int64_t>();
  for (const Box3l& box : boxes)
    if (!box.empty()) all.include(box);
  if (all.empty()) return;
  Cell root;
  root.lo = all.lo;
  root.log_size = log_size_of(longest_side(all) + 1);
  cells_.push_back(root);
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    if (!boxes[i].empty()) insert(i);
}

void LooseOctree::insert(std::uint32_t item) {
  const int log_size = log_size_of(longest_side(boxes_[item]));
  const Vec3l middle = middle_of(boxes_[item]);
  std::uint32_t cell = 0;
  while (cells_[cell].log_size > log_size) cell = child_of(cell, middle);
  next_[item] = cells_[cell].first_item;
  cells_[cell].first_item = item;
}

std::uint32_t LooseOctree::child_of(std::uint32_t cell, const Vec3l& middle) {
  const Cell parent = cells_[cell];
  const int log_half = parent.log_size - 1;
  Cell child;
  child.log_size = log_half;
  child.lo = parent.lo;
  std::size_t octant = 0;
  for (int k = 0; k < 3; ++k) {
    if ((middle[k] - parent.lo[k]) >> log_half == 0) continue;
    octant |= std::size_t{1} << static_cast<unsigned>(k);
    child.lo[k] += std::int64_t{1} << log_half;
  }
  if (parent.child[octant] != 0) return parent.child[octant];
  const auto made = static_cast<std::uint32_t>(cells_.size());
  cells_[cell].child[octant] = made;
  cells_.push_back(child);
  return made;
}

void LooseOctree::find(std::uint32_t item, TreeSearch& search) const {
  const Box3l& box = boxes_[item];
  if (box.empty()) return;
  search.stack.push_back(0);
  while (!search.stack.empty()) {
    const Cell& cell = cells_[search.stack.back()];
    search.stack.pop_back();
    for (std::uint32_t i = cell.first_item; i != kNone; i = next_[i]) {
      if (i <= item) continue;
      ++search.box_tests;
      if (meet(box, boxes_[i])) search.pairs.push_back({item, i});
    }
    for (const std::uint32_t child : cell.child) {
      if (child == 0) continue;
      ++search.node_tests;
      if (meet(box, cells_[child].loose_box())) search.stack.push_back(child);
    }
  }
}

}  // namespace strake::cli
