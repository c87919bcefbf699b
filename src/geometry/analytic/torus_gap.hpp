// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <queue>
#include <vector>

#include "geometry/analytic/convex_gap.hpp"
#include "geometry/analytic/pair_side.hpp"

namespace strake::geometry::analytic {

/// Work limit of a distance: the bracket is certain wherever it stops the search.
inline constexpr std::size_t kMaxGaps = 600;
/// Grid units: brackets this narrow are narrow enough.
inline constexpr double kTorusGap = 0.1;
/// Grid units: see Meeting in convex_pair.cpp.
inline constexpr double kTouch = 1;

/// An arc of either body, and what is proved about the two.
struct Cell {
  Arc a, b;
  double bound = 0;
  bool in_a = false;  ///< depth only: in which body it is measured
  std::size_t id = 0;
};

struct NearerFirst {
  bool operator()(const Cell& x, const Cell& y) const {
    return x.bound != y.bound ? x.bound > y.bound : x.id > y.id;
  }
};
/// The two halves of a cell, cut where its hulls stand off the most.
inline std::array<Cell, 2> halves(const PairSide& a, const PairSide& b, const Cell& cell) {
  std::array<Cell, 2> parts{cell, cell};
  const bool cut_a = a.slack(cell.a) >= b.slack(cell.b);
  const Arc& arc = cut_a ? cell.a : cell.b;
  (cut_a ? parts[0].a : parts[0].b) = Arc::between(arc.from, arc.middle());
  (cut_a ? parts[1].a : parts[1].b) = Arc::between(arc.middle(), arc.to);
  return parts;
}

/// Best first over pairs of arcs: the hulls' distance from below, points of the bodies from above.
class GapSearch {
 public:
  GapSearch(const PairSide& a, const PairSide& b, double enough)
      : a_(a), b_(b), enough_(enough), error_(a.error() + b.error()) {}

  ConvexGap run() {
    for (const Arc& a : a_.arcs())
      for (const Arc& b : b_.arcs())
        evaluate({a, b, -std::numeric_limits<double>::infinity(), false, 0});
    while (!open_.empty()) {
      const Cell cell = open_.top();
      best_.lower = cell.bound;
      if (finished() || count_ >= kMaxGaps || !(a_.slack(cell.a) + b_.slack(cell.b) > 0))
        return best_;
      open_.pop();
      for (const Cell& half : halves(a_, b_, cell)) evaluate(half);
    }
    best_.lower = best_.upper;
    return best_;
  }

  /// Two that touch face to face: no cell's hulls overlap by more than a touch along some face.
  [[nodiscard]] double touch_bound() {
    double least = best_.upper;
    for (; !open_.empty(); open_.pop()) {
      const Cell cell = open_.top();
      least = std::min(least, std::max(cell.bound, along_faces(cell)));
      if (least < -kTouch) break;
    }
    return least;
  }

 private:
  [[nodiscard]] bool finished() const {
    return best_.lower >= enough_ || best_.upper - best_.lower <= kTorusGap ||
           best_.upper <= error_ + kGapTolerance;
  }

  void evaluate(Cell cell) {
    ++count_;
    const ConvexGap gap =
        convex_gap(a_.hull(cell.a), b_.hull(cell.b), std::min(enough_, best_.upper));
    if (gap.upper < std::numeric_limits<double>::infinity()) improve(gap);
    cell.bound = std::max(cell.bound, gap.lower);
    cell.id = count_;
    if (cell.bound < best_.upper) open_.push(cell);
    if (cell.bound > most_parted_) {
      most_parted_ = cell.bound;
      best_.normal = gap.normal;
    }
  }

  void improve(const ConvexGap& gap) {
    const Vec3d p = a_.real(gap.on_a), q = b_.real(gap.on_b);
    try_points(p, q);
    if (a_.torus) try_points(a_.torus->nearest(q), q);
    if (b_.torus) try_points(p, b_.torus->nearest(p));
  }

  void try_points(const Vec3d& p, const Vec3d& q) {
    const double apart = norm(p - q) + error_;
    if (!(apart < best_.upper)) return;
    best_.upper = apart;
    best_.on_a = p;
    best_.on_b = q;
  }

  [[nodiscard]] double along_faces(const Cell& cell) const {
    const ConvexBody x = a_.hull(cell.a), y = b_.hull(cell.b);
    double widest = -std::numeric_limits<double>::infinity();
    const auto look = [&](const Vec3d& n) {
      const double slab = dot(n, support(x.shape, -n) - support(y.shape, n));
      widest = std::max(widest, slab - x.error - y.error);
    };
    look_along(a_, -1, look);
    look_along(b_, 1, look);
    return widest;
  }

  template <class Look>
  static void look_along(const PairSide& side, double sign, Look&& look) {
    for (std::size_t i = 0; side.field && i < side.field->planes(); ++i)
      look(side.field->normal(i) * sign);
    if (!side.torus) return;
    const SinCos end = sin_cos(side.torus->angle());
    for (const Vec3d& n :
         {Vec3d{0, -1, 0}, Vec3d{-end.sin, end.cos, 0}, Vec3d{0, 0, 1}, Vec3d{0, 0, -1}})
      look(side.torus->turned(n) * sign);
  }

  const PairSide &a_, &b_;
  double enough_, error_;
  ConvexGap best_;
  double most_parted_ = -std::numeric_limits<double>::infinity();
  std::size_t count_ = 0;
  std::priority_queue<Cell, std::vector<Cell>, NearerFirst> open_;
};

}  // namespace strake::geometry::analytic
