// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/part_tree.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>

namespace strake::geometry {
namespace {

constexpr std::size_t kBins = 8;
/// Ranges up to this size are halved by sorting: binning them costs more than it gains.
constexpr std::size_t kFew = 12;
/// The triangles of parts up to this size stay in their order: sources write down what is close
/// together one after the other, and a better tree would cost more than all that is asked of it.
constexpr std::size_t kSmallPart = 256;
/// Beyond this depth ranges are halved, so that traversal stacks can have a fixed size.
constexpr std::uint32_t kMaxSplitDepth = 40;

struct Reference {
  Box3i box;
  std::uint32_t triangle = 0;
};

/// Twice the centre of a box along an axis: exact, so bins depend on the numbers alone.
std::int64_t twice_centre(const Box3i& box, int axis) {
  return std::int64_t{box.lo[axis]} + box.hi[axis];
}

void grow(Box3i& box, const Box3i& by) {
  for (int k = 0; k < 3; ++k) {
    box.lo[k] = std::min(box.lo[k], by.lo[k]);
    box.hi[k] = std::max(box.hi[k], by.hi[k]);
  }
}

double half_area(const Box3i& box) {
  const Vec3d d = box.hi.as<double>() - box.lo.as<double>();
  return d.x * d.y + d.y * d.z + d.z * d.x;
}

struct Bin {
  Box3i box = empty_box<std::int32_t>();
  std::uint32_t count = 0;
};

using Bins = std::array<Bin, kBins>;

/// Slices of the node's box along its longest axis.
struct Binning {
  int axis = 0;
  std::int64_t low = 0;
  double scale = 0;

  explicit Binning(const Box3i& box) {
    const Vec3l d = box.hi.as<std::int64_t>() - box.lo.as<std::int64_t>();
    axis = d.x >= d.y && d.x >= d.z ? 0 : d.y >= d.z ? 1 : 2;
    low = 2 * std::int64_t{box.lo[axis]};
    if (d[axis] > 0) scale = kBins / (2 * static_cast<double>(d[axis]));
  }
  [[nodiscard]] std::size_t bin(const Box3i& box) const {
    const double offset = static_cast<double>(twice_centre(box, axis) - low) * scale;
    return std::min(kBins - 1, static_cast<std::size_t>(offset));
  }
};

/// The bin boundary with the least surface-area cost; 0 when all falls into one bin.
std::size_t best_boundary(const Bins& bins) {
  std::array<double, kBins> right_cost{};
  Box3i box = empty_box<std::int32_t>();
  std::uint32_t count = 0;
  for (std::size_t i = kBins; i-- > 1;) {
    grow(box, bins[i].box);
    count += bins[i].count;
    right_cost[i] = count == 0 ? 0 : half_area(box) * count;
  }
  box = empty_box<std::int32_t>();
  const std::uint32_t all = count + bins[0].count;
  count = 0;
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < kBins; ++i) {
    grow(box, bins[i - 1].box);
    count += bins[i - 1].count;
    if (count == 0 || count == all) continue;
    const double cost = half_area(box) * count + right_cost[i];
    if (cost < least) {
      least = cost;
      best = i;
    }
  }
  return best;
}

Box3i box_of(std::span<const Reference> refs) {
  Box3i box = empty_box<std::int32_t>();
  for (const Reference& ref : refs) grow(box, ref.box);
  return box;
}

/// Two non-empty groups: the size of the first, and their boxes.
struct Split {
  std::size_t first = 0;
  Box3i left = empty_box<std::int32_t>(), right = empty_box<std::int32_t>();
};

Split halve(std::span<Reference> refs, int axis) {
  const std::size_t half = refs.size() / 2;
  std::nth_element(refs.begin(), refs.begin() + static_cast<std::ptrdiff_t>(half), refs.end(),
                   [axis](const Reference& x, const Reference& y) {
                     const std::int64_t cx = twice_centre(x.box, axis);
                     const std::int64_t cy = twice_centre(y.box, axis);
                     return cx != cy ? cx < cy : x.triangle < y.triangle;
                   });
  return {half, box_of(refs.first(half)), box_of(refs.subspan(half))};
}

Split split(std::span<Reference> refs, const Box3i& box, std::uint32_t depth) {
  const Binning binning(box);
  if (refs.size() <= kFew || depth >= kMaxSplitDepth) return halve(refs, binning.axis);
  Bins bins;
  for (const Reference& ref : refs) {
    Bin& bin = bins[binning.bin(ref.box)];
    grow(bin.box, ref.box);
    ++bin.count;
  }
  const std::size_t boundary = best_boundary(bins);
  if (boundary == 0) return halve(refs, binning.axis);
  const auto middle = std::partition(refs.begin(), refs.end(), [&](const Reference& ref) {
    return binning.bin(ref.box) < boundary;
  });
  Split r;
  r.first = static_cast<std::size_t>(middle - refs.begin());
  for (std::size_t i = 0; i < kBins; ++i) grow(i < boundary ? r.left : r.right, bins[i].box);
  return r;
}

std::vector<Reference> references(const Part& part) {
  std::vector<Reference> refs(part.triangles.size());
  for (std::uint32_t i = 0; i < refs.size(); ++i) {
    refs[i].triangle = i;
    Box3i& box = refs[i].box;
    const Triangle& t = part.triangles[i];
    box.lo = box.hi = part.vertices[t[0]];
    box.include(part.vertices[t[1]]);
    box.include(part.vertices[t[2]]);
  }
  return refs;
}

Split halve_in_order(std::span<const Reference> refs) {
  // Whole leaves, so that there are as few as can be.
  const std::size_t leaves = (refs.size() + PartTree::kLeafSize - 1) / PartTree::kLeafSize;
  const std::size_t half = std::min(leaves / 2 * PartTree::kLeafSize, refs.size() - 1);
  return {half, box_of(refs.first(half)), box_of(refs.subspan(half))};
}

struct Range {
  std::uint32_t node = 0, first = 0, last = 0, depth = 0;
};

}  // namespace

PartTree::PartTree(const Part& part) {
  std::vector<Reference> refs = references(part);
  if (refs.empty()) return;
  nodes_.reserve(refs.size());
  nodes_.push_back({box_of(refs), 0, 0});
  std::vector<Range> todo{{0, 0, static_cast<std::uint32_t>(refs.size()), 0}};
  while (!todo.empty()) {
    const Range range = todo.back();
    todo.pop_back();
    const std::span<Reference> mine =
        std::span(refs).subspan(range.first, range.last - range.first);
    Node& node = nodes_[range.node];
    if (mine.size() <= kLeafSize) {
      node.first = range.first;
      node.count = static_cast<std::uint32_t>(mine.size());
      continue;
    }
    const Split halves =
        refs.size() <= kSmallPart ? halve_in_order(mine) : split(mine, node.box, range.depth);
    const auto middle = range.first + static_cast<std::uint32_t>(halves.first);
    const auto left = static_cast<std::uint32_t>(nodes_.size());
    node.first = left;
    nodes_.push_back({halves.left, 0, 0});
    nodes_.push_back({halves.right, 0, 0});
    todo.push_back({left + 1, middle, range.last, range.depth + 1});
    todo.push_back({left, range.first, middle, range.depth + 1});
  }
  order_.reserve(refs.size());
  for (const Reference& ref : refs) order_.push_back(ref.triangle);
}

}  // namespace strake::geometry
