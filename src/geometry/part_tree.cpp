// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/part_tree.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>

namespace strake::geometry {
namespace {

constexpr std::uint32_t kLeafSize = 4;
constexpr std::size_t kBins = 12;
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

struct CentreRange {
  Vec3l lo, hi;
};

CentreRange centre_range(std::span<const Reference> refs) {
  constexpr std::int64_t kFar = std::numeric_limits<std::int64_t>::max() / 4;
  CentreRange r{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  for (const Reference& ref : refs)
    for (int k = 0; k < 3; ++k) {
      const std::int64_t c = twice_centre(ref.box, k);
      r.lo[k] = std::min(r.lo[k], c);
      r.hi[k] = std::max(r.hi[k], c);
    }
  return r;
}

double half_area(const Box3i& box) {
  if (box.empty()) return 0;
  const Vec3d d = box.hi.as<double>() - box.lo.as<double>();
  return d.x * d.y + d.y * d.z + d.z * d.x;
}

struct Bin {
  Box3i box = empty_box<std::int32_t>();
  std::uint32_t count = 0;
};

struct Binning {
  int axis = 0;
  std::int64_t low = 0;
  double scale = 0;

  [[nodiscard]] std::size_t bin(const Box3i& box) const {
    const double offset = static_cast<double>(twice_centre(box, axis) - low) * scale;
    return std::min(kBins - 1, static_cast<std::size_t>(offset));
  }
};

/// The bin boundary with the least surface-area cost; 0 when all falls into one bin.
std::size_t best_boundary(const std::array<Bin, kBins>& bins) {
  std::array<double, kBins> right_cost{};
  Box3i box = empty_box<std::int32_t>();
  std::uint32_t count = 0;
  for (std::size_t i = kBins; i-- > 1;) {
    box.include(bins[i].box);
    count += bins[i].count;
    right_cost[i] = half_area(box) * count;
  }
  box = empty_box<std::int32_t>();
  const std::uint32_t all = count + bins[0].count;
  count = 0;
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < kBins; ++i) {
    box.include(bins[i - 1].box);
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

int longest_axis(const CentreRange& range) {
  const Vec3l d = range.hi - range.lo;
  return d.x >= d.y && d.x >= d.z ? 0 : d.y >= d.z ? 1 : 2;
}

/// Orders the references into two non-empty groups; the size of the first.
std::size_t split(std::span<Reference> refs, std::uint32_t depth) {
  const CentreRange range = centre_range(refs);
  const int axis = longest_axis(range);
  const std::int64_t extent = range.hi[axis] - range.lo[axis];
  if (extent > 0 && depth < kMaxSplitDepth) {
    const Binning binning{axis, range.lo[axis], kBins / static_cast<double>(extent)};
    std::array<Bin, kBins> bins;
    for (const Reference& ref : refs) {
      Bin& bin = bins[binning.bin(ref.box)];
      bin.box.include(ref.box);
      ++bin.count;
    }
    const std::size_t boundary = best_boundary(bins);
    if (boundary != 0) {
      const auto middle = std::partition(refs.begin(), refs.end(), [&](const Reference& ref) {
        return binning.bin(ref.box) < boundary;
      });
      return static_cast<std::size_t>(middle - refs.begin());
    }
  }
  const std::size_t half = refs.size() / 2;
  std::nth_element(refs.begin(), refs.begin() + static_cast<std::ptrdiff_t>(half), refs.end(),
                   [axis](const Reference& x, const Reference& y) {
                     const std::int64_t cx = twice_centre(x.box, axis);
                     const std::int64_t cy = twice_centre(y.box, axis);
                     return cx != cy ? cx < cy : x.triangle < y.triangle;
                   });
  return half;
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

struct Range {
  std::uint32_t node = 0, first = 0, last = 0, depth = 0;
};

}  // namespace

PartTree::PartTree(const Part& part) {
  std::vector<Reference> refs = references(part);
  if (refs.empty()) return;
  nodes_.reserve(refs.size());
  nodes_.emplace_back();
  std::vector<Range> todo{{0, 0, static_cast<std::uint32_t>(refs.size()), 0}};
  while (!todo.empty()) {
    const Range range = todo.back();
    todo.pop_back();
    const std::span<Reference> mine =
        std::span(refs).subspan(range.first, range.last - range.first);
    if (mine.size() <= kLeafSize) {
      Node& leaf = nodes_[range.node];
      leaf.first = range.first;
      leaf.count = static_cast<std::uint32_t>(mine.size());
      continue;
    }
    const auto middle = range.first + static_cast<std::uint32_t>(split(mine, range.depth));
    const auto left = static_cast<std::uint32_t>(nodes_.size());
    nodes_[range.node].first = left;
    nodes_.resize(nodes_.size() + 2);
    todo.push_back({left + 1, middle, range.last, range.depth + 1});
    todo.push_back({left, range.first, middle, range.depth + 1});
  }
  order_.reserve(refs.size());
  for (const Reference& ref : refs) order_.push_back(ref.triangle);
  // Children stand behind their parents.
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    node.box = empty_box<std::int32_t>();
    if (node.count == 0) {
      node.box.include(nodes_[node.first].box);
      node.box.include(nodes_[node.first + 1].box);
    }
    for (std::uint32_t k = 0; k < node.count; ++k) node.box.include(refs[node.first + k].box);
  }
}

}  // namespace strake::geometry
