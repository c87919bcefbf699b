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

#include "geometry/depth/simplex.hpp"
#include "geometry/range.hpp"

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
  const Vec3d n = normal_of(c);
  const double ln = length(n), le = length(edge);
  if (!(ln > 0) || !(le > 0)) return world;
  const Vec3d z = n * (1 / ln), x = edge * (1 / le);
  const Vec3d y = cross(z, x);
  const double ly = length(y);
  return {x, y * (1 / ly), z};
}

Range range_along(const DepthField& f, const Vec3d& axis) {
  if (f.has_many_vertices()) {
    const double at = dot(axis, f.common({}));
    return {at - f.vertices().greatest_along(-axis).value,
            at + f.vertices().greatest_along(axis).value};
  }
  Range r;
  for (const Vec3i& v : f.part().vertices) r.include(dot(axis, f.common(v.as<double>())));
  return r;
}

struct Cell {
  Simplex simplex;
  double upper = 0;  ///< no point of the cell that is in both is deeper
  std::uint32_t id = 0;
};

struct LessPromising {
  bool operator()(const Cell& x, const Cell& y) const {
    return x.upper != y.upper ? x.upper < y.upper : x.id > y.id;
  }
};

struct Edge {
  std::size_t from = 0, to = 1;
  double squared = 0;
};

Edge longest_edge(const Simplex& s) {
  Edge longest;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) {
      const Vec3d e = s.corner[j].at - s.corner[i].at;
      if (dot(e, e) > longest.squared) longest = {i, j, dot(e, e)};
    }
  return longest;
}

/// A cell no longer than this, grid units, is not cut further.
constexpr double kSmallest = 0.25;

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
    if (!plant()) return;
    double kept = 0;  // the greatest bound of a cell that is too small to cut
    while (!open_.empty()) {
      const double highest = std::max({open_.top().upper, kept, depth_.value});
      depth_.upper = std::min(ceiling, highest);
      if (bracket_suffices(depth_, goal_) || exhausted()) return;
      const Cell cell = open_.top();
      open_.pop();
      const Edge edge = longest_edge(cell.simplex);
      if (edge.squared <= kSmallest * kSmallest)
        kept = std::max(kept, cell.upper);
      else
        cut(cell, edge);
    }
    depth_.upper = std::min(ceiling, std::max(depth_.value + margin_, kept));
  }

 private:
  [[nodiscard]] bool exhausted() const {
    const bool decided = depth_.lower > goal_.threshold || depth_.upper <= goal_.threshold;
    return depth_.cells >= (decided ? goal_.cells_decided : goal_.cells_undecided);
  }

  /// The common box of the two in the frame, as the six simplices round one of its diagonals.
  bool plant() {
    Vec3d lo, size;
    double extent = 0;
    for (int k = 0; k < 3; ++k) {
      const Range x = range_along(a_, axes_[at(k)]), y = range_along(b_, axes_[at(k)]);
      const Range room = goal_.within ? range_along(*goal_.within, axes_[at(k)]) : x;
      lo[k] = std::max({x.lo, y.lo, room.lo}) - 1;
      size[k] = std::min({x.hi, y.hi, room.hi}) + 1 - lo[k];
      if (!(size[k] > 0)) return false;
      extent = std::max({extent, x.hi - x.lo, y.hi - y.lo});
    }
    margin_ = kFieldError * extent;
    slack_ = 1.0 / 1024 + margin_;
    std::array<SimplexCorner, 8> corners;
    for (unsigned i = 0; i < 8; ++i) {
      Vec3d p;
      for (int k = 0; k < 3; ++k)
        p = p + axes_[at(k)] * (lo[k] + ((i >> static_cast<unsigned>(k) & 1U) != 0 ? size[k] : 0));
      corners[i] = look(p, nullptr);
    }
    constexpr std::array<std::array<unsigned, 2>, 6> kPaths{
        {{1, 3}, {1, 5}, {2, 3}, {2, 6}, {4, 5}, {4, 6}}};
    for (const auto& path : kPaths) {
      const Cell cell{{{corners[0], corners[path[0]], corners[path[1]], corners[7]}},
                      std::numeric_limits<double>::infinity()};
      bound(cell);
    }
    return true;
  }

  static std::size_t at(int k) { return static_cast<std::size_t>(k); }

  /// A new corner; the side of a known one holds when no surface lies between the two.
  SimplexCorner look(const Vec3d& p, const SimplexCorner* known) {
    SimplexCorner corner{p, on_field_grid(p), {}, {}};
    corner.a = sample(a_, corner.sampled, known, known != nullptr ? &known->a : nullptr);
    corner.b = sample(b_, corner.sampled, known, known != nullptr ? &known->b : nullptr);
    if (corner.a.inside && corner.b.inside)
      improve(std::max(corner.a.distance, corner.b.distance), corner.sampled);
    return corner;
  }

  FieldSample sample(const DepthField& f, const Vec3d& p, const SimplexCorner* known,
                     const FieldSample* there) {
    FieldSample s;
    const NearestTriangle near = f.nearest(p, there != nullptr ? there->triangle : kNoFace);
    s.distance = near.distance;
    s.triangle = near.triangle;
    const bool same_side = there != nullptr && length(p - known->sampled) + margin_ <
                                                   std::max(there->distance, s.distance);
    s.inside = same_side ? there->inside : f.contains(p, work_);
    return s;
  }

  void cut(const Cell& cell, const Edge& edge) {
    const SimplexCorner &from = cell.simplex.corner[edge.from], &to = cell.simplex.corner[edge.to];
    const SimplexCorner middle = look((from.at + to.at) * 0.5, &from);
    for (const std::size_t replaced : {edge.from, edge.to}) {
      Cell child = cell;
      child.simplex.corner[replaced] = middle;
      bound(child);
    }
  }

  /// Keeps the cell if something in it may be deeper than what is known; `upper` comes from its
  /// parent.
  void bound(Cell cell) {
    ++depth_.cells;
    if (lies_elsewhere(cell.simplex)) return;
    const auto bounds = bound_depth(a_, b_, cell.simplex, slack_, depth_.value + margin_, work_);
    if (!bounds) return;
    double most = 0;
    for (const SimplexBound& b : *bounds) {
      most = std::max(most, b.upper);
      if (b.upper > depth_.value + margin_) try_point(b.point);
    }
    cell.upper = std::min(cell.upper, most);
    if (cell.upper <= depth_.value + margin_) return;
    cell.id = next_id_++;
    open_.push(cell);
  }

  /// Whether all of a simplex lies in one part of what is common, and that does not count.
  [[nodiscard]] bool lies_elsewhere(const Simplex& s) const {
    if (!goal_.belongs) return false;
    for (const SimplexCorner& c : s.corner) {
      if (!c.a.inside || !c.b.inside) continue;
      double radius = 0;
      for (const SimplexCorner& other : s.corner)
        radius = std::max(radius, length(other.at - c.sampled));
      // No skin within that radius.
      if (std::min(c.a.distance, c.b.distance) > radius + slack_) return !goal_.belongs(c.sampled);
    }
    return false;
  }

  void try_point(const Vec3d& p) {
    const Vec3d q = on_field_grid(p);
    const double depth = greater_distance(a_, b_, q);
    if (depth > depth_.value && a_.contains(q, work_) && b_.contains(q, work_)) improve(depth, q);
  }

  void improve(double depth, const Vec3d& at) {
    if (!(depth > depth_.value)) return;
    if (!goal_.counts(at)) return;
    depth_.value = depth;
    depth_.lower = std::max(0.0, depth - margin_);
    depth_.point = at;
  }

  const DepthField &a_, &b_;
  const DepthGoal& goal_;
  Depth& depth_;
  PairWork& work_;
  Axes axes_;
  double margin_ = 0, slack_ = 0;
  std::priority_queue<Cell, std::vector<Cell>, LessPromising> open_;
  std::uint32_t next_id_ = 0;
};

}  // namespace

void search_solid_depth(const DepthField& a, const DepthField& b, const DepthGoal& goal,
                        Depth& depth, PairWork& work) {
  Search(a, b, goal, depth, work).run();
}

}  // namespace strake::geometry
