// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/support_tree.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include "core/parting.hpp"
#include "geometry/bvh/top_down_builder.hpp"
#include "geometry/numeric/vector_math.hpp"

namespace strake::geometry {
namespace {

/// Up to this many points a scan of all is faster.
constexpr std::size_t kFewVertices = 48;
// Between 2 and 32 ships show no difference (decision 0073).
constexpr std::uint32_t kVerticesPerLeaf = 8;
/// Halving 2^32 points takes 29 levels down to the leaves; a traversal keeps one node per level.
constexpr std::size_t kDepth = 40;

double along(const Vec3d& n, const Vec3i& v) {
  return n.x * static_cast<double>(v.x) + n.y * static_cast<double>(v.y) +
         n.z * static_cast<double>(v.z);
}

/// No point of the box gives more: its far corner is summed in the same order, and rounding never
/// changes the order of two numbers.
double along(const Vec3d& n, const Box3i& box) {
  return along(n, Vec3i{n.x < 0 ? box.lo.x : box.hi.x, n.y < 0 ? box.lo.y : box.hi.y,
                        n.z < 0 ? box.lo.z : box.hi.z});
}

int longest_axis(const Box3i& box) {
  const Vec3l d = box.hi.as<std::int64_t>() - box.lo.as<std::int64_t>();
  return d.x >= d.y && d.x >= d.z ? 0 : d.y >= d.z ? 1 : 2;
}

}  // namespace

SupportTree::SupportTree(std::span<const Vec3i> points, const parallel::Context& context)
    : points_(points.begin(), points.end()) {
  if (points_.size() <= kFewVertices) return;
  const auto of = [&](const BuildRange& range) {
    return std::span(points_).subspan(range.first, range.size());
  };
  const auto cut = [&](const BuildRange& range, const Box3i& box) {
    const auto mine = of(range);
    const std::size_t half = mine.size() / 2;
    part_at(mine, half, [axis = longest_axis(box)](const Vec3i& a, const Vec3i& b) {
      return a[axis] != b[axis] ? a[axis] < b[axis] : a < b;
    });
    return RangeSplit{static_cast<std::uint32_t>(half), box_of(mine.first(half)),
                      box_of(mine.subspan(half))};
  };
  const auto settle = [&](const BuildRange& range) { std::ranges::sort(of(range)); };
  nodes_ = TopDownBuilder<Node, decltype(cut), decltype(settle)>(kVerticesPerLeaf, cut, settle)
               .run(box_of(points_), static_cast<std::uint32_t>(points_.size()), context);
}

SupportTree::SupportPoint SupportTree::support_along(const Vec3d& n) const {
  SupportPoint best{-std::numeric_limits<double>::infinity(), {}};
  const auto test_points = [&](std::span<const Vec3i> points) {
    for (const Vec3i& p : points) {
      const double value = along(n, p);
      if (value > best.value) best = {value, p};
    }
  };
  if (nodes_.empty()) {
    test_points(points_);
    return best;
  }
  std::array<std::pair<std::uint32_t, double>, kDepth> stack;
  std::size_t size = 0;
  stack[size++] = {0, along(n, nodes_.front().box)};
  while (size > 0) {
    const auto [index, limit] = stack[--size];
    if (!(limit > best.value)) continue;
    const Node& node = nodes_[index];
    if (node.count > 0) {
      test_points(std::span(points_).subspan(node.first, node.count));
      continue;
    }
    std::pair near{node.first, along(n, nodes_[node.first].box)};
    std::pair far{node.first + 1, along(n, nodes_[node.first + 1].box)};
    if (far.second > near.second) std::swap(near, far);
    stack[size++] = far;
    stack[size++] = near;
  }
  return best;
}

std::vector<Vec3i> SupportTree::points_within(const Box3d& box, std::size_t limit) const {
  std::vector<Vec3i> found;
  const auto take = [&](std::span<const Vec3i> points) {
    for (const Vec3i& p : points) {
      const Vec3d at = p.as<double>();
      if (found.size() < limit && box.contains({at, at})) found.push_back(p);
    }
  };
  if (nodes_.empty()) {
    take(points_);
    return found;
  }
  std::array<std::uint32_t, kDepth> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0 && found.size() < limit) {
    const Node& node = nodes_[stack[--size]];
    if (!node.box.as<double>().meets(box)) continue;
    if (node.count > 0) {
      take(std::span(points_).subspan(node.first, node.count));
    } else {
      stack[size++] = node.first + 1;
      stack[size++] = node.first;
    }
  }
  return found;
}

bool SupportTree::all_at_or_below(const Vec3d& n, double level, std::uint64_t& boxes) const {
  const auto none_of = [&](std::span<const Vec3i> points) {
    return std::none_of(points.begin(), points.end(),
                        [&](const Vec3i& p) { return along(n, p) > level; });
  };
  if (nodes_.empty()) return none_of(points_);
  std::array<std::uint32_t, kDepth> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    if (boxes == 0) return false;
    --boxes;
    if (!(along(n, node.box) > level)) continue;
    if (node.count == 0) {
      stack[size++] = node.first + 1;
      stack[size++] = node.first;
    } else if (!none_of(std::span(points_).subspan(node.first, node.count))) {
      return false;
    }
  }
  return true;
}

}  // namespace strake::geometry
