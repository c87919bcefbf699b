// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "clash/group/partition.hpp"
#include "core/union_find.hpp"

namespace strake::clash {
namespace {

using geometry::Box3d;
using geometry::Vec3d;
using geometry::Vec3l;

double squared_distance(const Vec3d& p, const Vec3d& q) {
  const Vec3d d = p - q;
  return dot(d, d);
}

double squared_distance(const Vec3d& p, const Box3d& box) {
  Vec3d d;
  for (int k = 0; k < 3; ++k) d[k] = std::max({box.lo[k] - p[k], p[k] - box.hi[k], 0.0});
  return dot(d, d);
}

/// Points so near each other that all are in one group: the diagonal of a cell is below the
/// distance.
struct ProximityCell {
  Vec3l at;
  std::size_t first = 0, last = 0;  ///< in the sorted order of the points
  Box3d box = geometry::empty_box<double>();
};

class Linkage {
 public:
  Linkage(std::span<const GroupingItem> items, double distance)
      : items_(items), squared_(distance * distance), side_(distance / 2), sets_(items.size()) {
    order_.resize(items.size());
    std::iota(order_.begin(), order_.end(), std::uint32_t{0});
    places_.reserve(items.size());
    for (const GroupingItem& item : items) places_.push_back(place(item.pair->point_mm));
    std::ranges::sort(order_, [&](std::uint32_t i, std::uint32_t j) {
      return places_[i] != places_[j] ? places_[i] < places_[j] : i < j;
    });
  }

  UnionFind& run() {
    make_cells();
    for (std::size_t c = 0; c < cells_.size(); ++c)
      for (std::int64_t dx = 0; dx <= kReach; ++dx)
        for (std::int64_t dy = dx == 0 ? 0 : -kReach; dy <= kReach; ++dy) row(c, dx, dy);
    return sets_;
  }

 private:
  /// Points within the distance are no more than two cells apart along each axis.
  static constexpr std::int64_t kReach = 2;

  [[nodiscard]] Vec3l place(const Vec3d& p) const {
    const auto cell = [&](double x) { return static_cast<std::int64_t>(std::floor(x / side_)); };
    return {cell(p.x), cell(p.y), cell(p.z)};
  }
  [[nodiscard]] const Vec3d& point(std::size_t sorted) const {
    return items_[order_[sorted]].pair->point_mm;
  }

  void make_cells() {
    for (std::size_t i = 0; i < order_.size(); ++i) {
      if (i == 0 || places_[order_[i]] != places_[order_[i - 1]])
        cells_.push_back({places_[order_[i]], i, i});
      cells_.back().last = i + 1;
      cells_.back().box.include(point(i));
      sets_.join(order_[cells_.back().first], order_[i]);
    }
  }

  /// Visits the cells of a row beside a cell; where the row is its own, those after it.
  void row(std::size_t c, std::int64_t dx, std::int64_t dy) {
    const Vec3l& at = cells_[c].at;
    const bool own = dx == 0 && dy == 0;
    const Vec3l from{at.x + dx, at.y + dy, own ? at.z + 1 : at.z - kReach};
    const Vec3l to{at.x + dx, at.y + dy, at.z + kReach};
    auto it = std::ranges::lower_bound(cells_, from, {}, &ProximityCell::at);
    for (; it != cells_.end() && it->at <= to; ++it) link(cells_[c], *it);
  }

  void link(const ProximityCell& x, const ProximityCell& y) {
    if (sets_.joined(order_[x.first], order_[y.first])) return;
    for (std::size_t i = x.first; i < x.last; ++i) {
      if (squared_distance(point(i), y.box) > squared_) continue;
      for (std::size_t j = y.first; j < y.last; ++j)
        if (squared_distance(point(i), point(j)) <= squared_)
          return void(sets_.join(order_[i], order_[j]));
    }
  }

  std::span<const GroupingItem> items_;
  double squared_, side_;
  UnionFind sets_;
  std::vector<std::uint32_t> order_;
  std::vector<Vec3l> places_;
  std::vector<ProximityCell> cells_;
};

}  // namespace

Partition by_proximity(std::span<const GroupingItem> items, double distance_mm) {
  Linkage linkage(items, distance_mm);
  UnionFind& sets = linkage.run();
  Partition partition;
  partition.group.resize(items.size());
  for (std::uint32_t i = 0; i < items.size(); ++i) {
    const std::uint32_t root = sets.root(i);  // the lowest: numbered before any other of its set
    partition.group[i] = root == i ? partition.count++ : partition.group[root];
  }
  return partition;
}

}  // namespace strake::clash
