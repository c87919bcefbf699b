// SPDX-License-Identifier: Apache-2.0
#include "geometry/depth/depth_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace strake::geometry {
namespace {

using Axes = std::array<Vec3d, 3>;

/// An orthonormal frame along a triangle's normal and longest edge: what meets there is flat in
/// this frame even when the model stands askew.
Axes frame_of(const Part& part, std::uint32_t triangle) {
  const Axes world{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
  if (triangle >= part.triangles.size()) return world;
  const Corners c = corners_of(part, triangle);
  Vec3d edge = c[1] - c[0];
  for (std::size_t i = 1; i < 3; ++i) {
    const Vec3d e = c[(i + 1) % 3] - c[i];
    if (dot(e, e) > dot(edge, edge)) edge = e;
  }
  const Vec3d n = cross(c[1] - c[0], c[2] - c[0]);
  const double ln = length(n), le = length(edge);
  if (!(ln > 0) || !(le > 0)) return world;
  const Vec3d z = n * (1 / ln), x = edge * (1 / le);
  const Vec3d y = cross(z, x);
  const double ly = length(y);
  return {x, y * (1 / ly), z};
}

struct Range {
  double lo = std::numeric_limits<double>::infinity();
  double hi = -std::numeric_limits<double>::infinity();
};

Range range_along(const DepthField& f, const Vec3d& axis) {
  Range r;
  for (const Vec3i& v : f.part().vertices) {
    const double t = dot(axis, f.common(v.as<double>()));
    r.lo = std::min(r.lo, t);
    r.hi = std::max(r.hi, t);
  }
  return r;
}

/// What is known of a part at the centre of a cell.
struct Sample {
  double distance = 0;
  std::uint32_t triangle = kNoFace;
  bool inside = false;
};

struct Cell {
  Vec3d centre;
  Vec3d half;  ///< along the axes of the frame
  Sample a, b;
  double upper = 0;  ///< no point of the cell that is in both is deeper
  int split = 0;     ///< the axis that the bound suffers from most
  std::uint32_t id = 0;
};

struct LessPromising {
  bool operator()(const Cell& x, const Cell& y) const {
    return x.upper != y.upper ? x.upper < y.upper : x.id > y.id;
  }
};

class Search {
 public:
  Search(const DepthField& a, const DepthField& b, const DepthGoal& goal, Depth& depth,
         PairWork& work)
      : a_(a),
        b_(b),
        goal_(goal),
        depth_(depth),
        work_(work),
        axes_(frame_of(a.part(), goal.triangle_a)) {}

  void run() {
    const double ceiling = depth_.upper;
    Cell root;
    if (!place_root(root)) return;
    evaluate(root, nullptr);
    while (!open_.empty()) {
      depth_.upper = std::min(ceiling, std::max(open_.top().upper, depth_.value));
      if (bracket_suffices(depth_, goal_) || exhausted()) return;
      const Cell cell = open_.top();
      open_.pop();
      const double half = cell.half[cell.split] / 2;
      for (const double side : {-1.0, 1.0}) {
        Cell child = cell;
        child.half[cell.split] = half;
        child.centre = cell.centre + axes_[static_cast<std::size_t>(cell.split)] * (side * half);
        evaluate(child, &cell);
      }
    }
    depth_.upper = std::min(ceiling, depth_.value + margin_);
  }

 private:
  [[nodiscard]] bool exhausted() const {
    const bool decided = depth_.lower > goal_.threshold || depth_.upper <= goal_.threshold;
    return depth_.cells >= (decided ? goal_.cells_decided : goal_.cells_undecided);
  }

  bool place_root(Cell& root) {
    double extent = 0;
    for (int k = 0; k < 3; ++k) {
      const Vec3d& axis = axes_[static_cast<std::size_t>(k)];
      const Range x = range_along(a_, axis), y = range_along(b_, axis);
      const double lo = std::max(x.lo, y.lo) - 1, hi = std::min(x.hi, y.hi) + 1;
      if (!(lo < hi)) return false;
      extent = std::max({extent, x.hi - x.lo, y.hi - y.lo});
      root.half[k] = (hi - lo) / 2;
      root.centre = root.centre + axis * ((lo + hi) / 2);
    }
    margin_ = kFieldError * extent;
    return true;
  }

  /// The parent's side holds when no surface lies between the two centres.
  Sample sample(const DepthField& f, const Vec3d& at, const Sample* parent, double moved) {
    Sample s;
    const NearestTriangle near = f.nearest(at, parent != nullptr ? parent->triangle : kNoFace);
    s.distance = near.distance;
    s.triangle = near.triangle;
    s.inside = parent != nullptr && moved < parent->distance * (1 - kFieldError)
                   ? parent->inside
                   : f.contains(at, work_);
    return s;
  }

  /// Greatest distance of the cell's corners to the triangle nearest its centre, and the axis
  /// along which the worst corner lies farthest from it.
  double corner_bound(const DepthField& f, const Cell& cell, const Vec3d& at, std::uint32_t t,
                      int& axis) const {
    const Corners corners = corners_of(f.part(), t);
    double worst = -1;
    for (unsigned i = 0; i < 8; ++i) {
      Vec3d p = at;
      for (unsigned k = 0; k < 3; ++k)
        p = p + axes_[k] * ((i >> k & 1U) != 0 ? cell.half[static_cast<int>(k)]
                                               : -cell.half[static_cast<int>(k)]);
      const Vec3d q = f.local(p);
      const Vec3d away = q - nearest_on_triangle(q, corners);
      const double d = length(away);
      if (!(d > worst)) continue;
      worst = d;
      double most = -1;
      for (int k = 0; k < 3; ++k) {
        const double pull = std::fabs(dot(away, axes_[static_cast<std::size_t>(k)])) * cell.half[k];
        if (pull > most) {
          most = pull;
          axis = k;
        }
      }
    }
    return worst;
  }

  void evaluate(Cell& cell, const Cell* parent) {
    ++depth_.cells;
    const Vec3d at = on_field_grid(cell.centre);
    const double slack = 1.0 / 1024 + margin_;  // the centre moved to the field grid
    const double radius = length(cell.half) + slack;
    const double moved =
        parent != nullptr ? length(at - on_field_grid(parent->centre)) + margin_ : 0;
    cell.a = sample(a_, at, parent != nullptr ? &parent->a : nullptr, moved);
    if (!cell.a.inside && cell.a.distance > radius) return;
    cell.b = sample(b_, at, parent != nullptr ? &parent->b : nullptr, moved);
    if (!cell.b.inside && cell.b.distance > radius) return;
    if (cell.a.inside && cell.b.inside) improve(std::max(cell.a.distance, cell.b.distance), at);
    int split_a = 0, split_b = 0;
    const double in_a = bound(a_, cell, cell.a, at, radius, split_a) + slack;
    const double in_b = bound(b_, cell, cell.b, at, radius, split_b) + slack;
    cell.upper = std::max(in_a, in_b);
    if (parent != nullptr) cell.upper = std::min(cell.upper, parent->upper);
    if (cell.upper <= depth_.value + margin_) return;
    cell.split = in_a >= in_b ? split_a : split_b;
    cell.id = next_id_++;
    open_.push(cell);
  }

  double bound(const DepthField& f, const Cell& cell, const Sample& s, const Vec3d& at,
               double radius, int& axis) const {
    const double moved = s.inside ? s.distance + radius : radius - s.distance;
    return std::min(moved, corner_bound(f, cell, at, s.triangle, axis));
  }

  void improve(double depth, const Vec3d& at) {
    if (!(depth > depth_.value)) return;
    depth_.value = depth;
    depth_.lower = std::max(0.0, depth - margin_);
    depth_.point = at;
  }

  const DepthField &a_, &b_;
  const DepthGoal& goal_;
  Depth& depth_;
  PairWork& work_;
  Axes axes_;
  double margin_ = 0;
  std::priority_queue<Cell, std::vector<Cell>, LessPromising> open_;
  std::uint32_t next_id_ = 0;
};

}  // namespace

void search_solid_depth(const DepthField& a, const DepthField& b, const DepthGoal& goal,
                        Depth& depth, PairWork& work) {
  Search(a, b, goal, depth, work).run();
}

}  // namespace strake::geometry
