// SPDX-License-Identifier: Apache-2.0
#include "page/geometry/near_points.hpp"

#include <algorithm>
#include <optional>

#include "strake/geometry/grid.hpp"

namespace strake::page {
namespace {

/// Divides rounding down.
std::int64_t floor_div(std::int64_t value, std::int64_t by) {
  return value / by - (value % by < 0 ? 1 : 0);
}

}  // namespace

NearPoints::NearPoints(std::span<const geometry::Vec3d> points_mm, double reach_mm)
    : reach_(std::max<std::int64_t>(geometry::snap(reach_mm).value_or(1), 1)) {
  for (const geometry::Vec3d& mm : points_mm)
    if (const std::optional<geometry::Vec3l> point = geometry::snap(mm)) points_.push_back(*point);
  std::ranges::sort(points_, [this](const geometry::Vec3l& x, const geometry::Vec3l& y) {
    return std::pair(cell_of(x), x) < std::pair(cell_of(y), y);
  });
  for (std::size_t i = 0; i < points_.size(); ++i) {
    auto& run = cells_.try_emplace(cell_of(points_[i]), i, i).first->second;
    run.second = i + 1;
  }
}

NearPoints::Cell NearPoints::cell_of(const geometry::Vec3l& point) const {
  const std::int64_t side = 2 * reach_;
  return {floor_div(point.x, side), floor_div(point.y, side), floor_div(point.z, side)};
}

bool NearPoints::holds_near(std::pair<std::size_t, std::size_t> run,
                            const geometry::Box3l& reached) const {
  return std::any_of(points_.begin() + static_cast<std::ptrdiff_t>(run.first),
                     points_.begin() + static_cast<std::ptrdiff_t>(run.second),
                     [&](const geometry::Vec3l& p) { return reached.contains({p, p}); });
}

bool NearPoints::is_near(const geometry::Box3l& box) const {
  if (box.empty() || cells_.empty()) return false;
  const geometry::Box3l reached = box.inflated(reach_);
  const Cell lo = cell_of(reached.lo), hi = cell_of(reached.hi);
  const auto cells = static_cast<double>(hi.x - lo.x + 1) * static_cast<double>(hi.y - lo.y + 1) *
                     static_cast<double>(hi.z - lo.z + 1);
  // A box over most of a ship has more cells than there are places.
  if (cells >= static_cast<double>(cells_.size())) return holds_near({0, points_.size()}, reached);
  Cell cell;
  for (cell.x = lo.x; cell.x <= hi.x; ++cell.x)
    for (cell.y = lo.y; cell.y <= hi.y; ++cell.y)
      for (cell.z = lo.z; cell.z <= hi.z; ++cell.z)
        if (const auto at = cells_.find(cell);
            at != cells_.end() && holds_near(at->second, reached))
          return true;
  return false;
}

}  // namespace strake::page
