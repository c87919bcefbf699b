// SPDX-License-Identifier: Apache-2.0
#include "geometry/polygon/sweep.hpp"

#include <cstddef>
#include <utility>

namespace strake::geometry::polygon {
namespace {

class Sweep {
 public:
  explicit Sweep(std::vector<Point2> points)
      : cells_(std::move(points)),
        next_(cells_.points().size(), kNone),
        previous_(cells_.points().size(), kNone),
        cell_(cells_.points().size(), kNone) {}

  Cells run() {
    const std::size_t count = cells_.points().size();
    const std::uint32_t used = count < 3 ? 0 : start_fan();
    if (used == 0) return std::move(cells_);
    cells_.reserve(count * 2);
    for (std::uint32_t p = used; p < count; ++p) insert(p);
    return std::move(cells_);
  }

 private:
  std::uint32_t start_fan();
  void insert(std::uint32_t point);
  void note_hull(std::uint32_t cell);

  Cells cells_;
  // The hull, by vertex.
  std::vector<std::uint32_t> next_, previous_;
  std::vector<std::uint32_t> cell_;  ///< the triangle at the hull edge that starts there
};

/// Of a triangle's edges.
void Sweep::note_hull(std::uint32_t cell) {
  const Cell& c = cells_[cell];
  for (std::uint32_t k = 0; k < 3; ++k)
    if (c.neighbour[k] == kNone) cell_[c.vertex[after(k)]] = cell;
}

/// Joins the first points, as long as they are collinear, with the first that is not; returns the
/// number of points used, or 0 when all are collinear.
std::uint32_t Sweep::start_fan() {
  const auto count = static_cast<std::uint32_t>(cells_.points().size());
  std::uint32_t apex = 2;
  while (apex < count && cells_.side(0, 1, apex) == 0) ++apex;
  if (apex >= count) return 0;
  const bool left = cells_.side(0, 1, apex) > 0;
  std::vector<std::uint32_t> hull;
  for (std::uint32_t i = 0; i < apex; ++i) hull.push_back(left ? i : apex - 1 - i);
  std::uint32_t previous = kNone;
  for (std::size_t i = 0; i + 1 < hull.size(); ++i) {
    const std::uint32_t cell = cells_.add(hull[i], hull[i + 1], apex);
    if (previous != kNone) cells_.join(previous, cell, hull[i], apex);
    previous = cell;
  }
  hull.push_back(apex);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const std::uint32_t a = hull[i], b = hull[i + 1 == hull.size() ? 0 : i + 1];
    next_[a] = b;
    previous_[b] = a;
  }
  for (std::uint32_t cell = 0; cell < cells_.all().size(); ++cell) note_hull(cell);
  return apex + 1;
}

/// Adds a point beyond all others: it sees the hull edges round the last one.
void Sweep::insert(std::uint32_t point) {
  const std::uint32_t last = point - 1;
  std::uint32_t ahead = last, behind = last, first_ahead = kNone, first_behind = kNone;
  std::uint32_t newest = kNone;
  while (cells_.side(ahead, next_[ahead], point) < 0) {
    const std::uint32_t next = next_[ahead];
    const std::uint32_t cell = cells_.add(next, ahead, point);
    cells_.join(cell, cell_[ahead], next, ahead);
    if (newest != kNone) cells_.join(newest, cell, point, ahead);
    if (first_ahead == kNone) first_ahead = cell;
    cells_.doubt({cell, 2});
    newest = cell;
    ahead = next;
  }
  std::uint32_t newest_behind = kNone;
  while (cells_.side(previous_[behind], behind, point) < 0) {
    const std::uint32_t next = previous_[behind];
    const std::uint32_t cell = cells_.add(behind, next, point);
    cells_.join(cell, cell_[next], behind, next);
    if (newest_behind != kNone) cells_.join(newest_behind, cell, behind, point);
    if (first_behind == kNone) first_behind = cell;
    cells_.doubt({cell, 2});
    newest_behind = cell;
    behind = next;
  }
  if (first_ahead != kNone && first_behind != kNone)
    cells_.join(first_ahead, first_behind, last, point);
  next_[behind] = point;
  previous_[point] = behind;
  next_[point] = ahead;
  previous_[ahead] = point;
  cell_[behind] = newest_behind != kNone ? newest_behind : first_ahead;
  cell_[point] = newest != kNone ? newest : first_behind;
  cells_.legalise([&](std::uint32_t cell) { note_hull(cell); });
}

}  // namespace

Cells swept(std::vector<Point2> points) { return Sweep(std::move(points)).run(); }

}  // namespace strake::geometry::polygon
