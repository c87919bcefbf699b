// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <queue>
#include <vector>

#include "geometry/primitive_pairs/solvers/convex_depth.hpp"
#include "geometry/primitive_pairs/solvers/gjk.hpp"
#include "geometry/primitive_pairs/solvers/primitive_operand.hpp"
#include "geometry/primitive_pairs/solvers/torus_depth.hpp"

namespace strake::geometry::primitive_pairs {

/// Work limit of a distance search, in arc pairs: the bracket is certain wherever the search stops.
/// Of 50,000 seeded pairs with a torus two end at this limit or that of depths, with brackets of
/// some ten-thousandths of their size.
inline constexpr std::size_t kMaxDistanceCells = 600;
/// Grid units: a bracket this narrow ends the search.
inline constexpr double kTorusDistanceTolerance = 0.1;
/// Grid units: see OverlappingPair in convex_pair.cpp.
inline constexpr double kTouch = 1;

/// An arc of either body, and the bound proved for the two.
struct ArcPair {
  SweptArc a, b;
  double bound = 0;
  bool in_a = false;  ///< depth only: in which body it is measured
  std::size_t id = 0;
};

struct LowerDistanceFirst {
  bool operator()(const ArcPair& x, const ArcPair& y) const {
    return x.bound != y.bound ? x.bound > y.bound : x.id > y.id;
  }
};
/// Returns the two halves of an arc pair, split where its hulls lie off the bodies most.
inline std::array<ArcPair, 2> split_arc_pair(const PrimitiveOperand& a, const PrimitiveOperand& b,
                                             const ArcPair& cell) {
  std::array<ArcPair, 2> parts{cell, cell};
  const bool cut_a = a.hull_error(cell.a) >= b.hull_error(cell.b);
  const SweptArc& arc = cut_a ? cell.a : cell.b;
  (cut_a ? parts[0].a : parts[0].b) = SweptArc::between(arc.from, arc.middle());
  (cut_a ? parts[1].a : parts[1].b) = SweptArc::between(arc.middle(), arc.to);
  return parts;
}

/// Best-first search over pairs of arcs: the hulls' distance bounds from below, points of the
/// bodies from above.
class TorusDistanceSearch {
 public:
  TorusDistanceSearch(const PrimitiveOperand& a, const PrimitiveOperand& b, double cutoff)
      : a_(a), b_(b), cutoff_(cutoff), error_(a.error() + b.error()) {}

  GjkResult run() {
    for (const SweptArc& a : a_.arcs())
      for (const SweptArc& b : b_.arcs())
        evaluate({a, b, -std::numeric_limits<double>::infinity(), false, 0});
    while (!open_.empty()) {
      const ArcPair cell = open_.top();
      best_.lower = cell.bound;
      if (finished() || count_ >= kMaxDistanceCells ||
          !(a_.hull_error(cell.a) + b_.hull_error(cell.b) > 0))
        return best_;
      open_.pop();
      for (const ArcPair& half : split_arc_pair(a_, b_, cell)) evaluate(half);
    }
    best_.lower = best_.upper;
    return best_;
  }

  /// Returns a bound for two bodies that touch face to face: no pair's hulls overlap by more than
  /// kTouch along some face.
  [[nodiscard]] double touch_bound() {
    double least = best_.upper;
    for (; !open_.empty(); open_.pop()) {
      const ArcPair cell = open_.top();
      least = std::min(least, std::max(cell.bound, along_faces(cell)));
      if (least < -kTouch) break;
    }
    return least;
  }

 private:
  [[nodiscard]] bool finished() const {
    return best_.lower >= cutoff_ || best_.upper - best_.lower <= kTorusDistanceTolerance ||
           best_.upper <= error_ + kGapTolerance;
  }

  void evaluate(ArcPair cell) {
    ++count_;
    const GjkResult gap =
        gjk_distance(a_.hull(cell.a), b_.hull(cell.b), std::min(cutoff_, best_.upper));
    if (gap.upper < std::numeric_limits<double>::infinity()) improve(gap);
    cell.bound = std::max(cell.bound, gap.lower);
    cell.id = count_;
    if (cell.bound < best_.upper) open_.push(cell);
    if (cell.bound > max_bound_) {
      max_bound_ = cell.bound;
      best_.normal = gap.normal;
    }
  }

  void improve(const GjkResult& gap) {
    const Vec3d p = a_.point_in_body(gap.on_a), q = b_.point_in_body(gap.on_b);
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

  [[nodiscard]] double along_faces(const ArcPair& cell) const {
    const ConvexBody x = a_.hull(cell.a), y = b_.hull(cell.b);
    double widest = -std::numeric_limits<double>::infinity();
    const auto visit = [&](const Vec3d& n) {
      const double slab = dot(n, support(x.shape, -n) - support(y.shape, n));
      widest = std::max(widest, slab - x.error - y.error);
    };
    for_each_face_normal(a_, -1, visit);
    for_each_face_normal(b_, 1, visit);
    return widest;
  }

  template <class Visit>
  static void for_each_face_normal(const PrimitiveOperand& side, double sign, Visit&& visit) {
    for (std::size_t i = 0; side.field && i < side.field->planes(); ++i)
      visit(side.field->normal(i) * sign);
    if (!side.torus) return;
    const SinCos end = sin_cos(side.torus->angle());
    for (const Vec3d& n :
         {Vec3d{0, -1, 0}, Vec3d{-end.sin, end.cos, 0}, Vec3d{0, 0, 1}, Vec3d{0, 0, -1}})
      visit(side.torus->turned(n) * sign);
  }

  const PrimitiveOperand &a_, &b_;
  double cutoff_, error_;
  GjkResult best_;
  double max_bound_ = -std::numeric_limits<double>::infinity();
  std::size_t count_ = 0;
  std::priority_queue<ArcPair, std::vector<ArcPair>, LowerDistanceFirst> open_;
};

/// Work limit of a depth search, in arc pairs: the bracket is certain wherever the search stops.
inline constexpr std::size_t kMaxDepthCells = 300;
/// Grid units: a bracket this narrow ends the search.
inline constexpr double kTorusDepthTolerance = 0.25;

struct GreaterDepthFirst {
  bool operator()(const ArcPair& x, const ArcPair& y) const {
    return x.bound != y.bound ? x.bound < y.bound : x.id > y.id;
  }
};

/// Best-first search over pairs of arcs and both bodies: cutting planes bound each.
class TorusDepthSearch {
 public:
  TorusDepthSearch(const PrimitiveOperand& a, const PrimitiveOperand& b) : a_(a), b_(b) {}

  DeepestPoint run() {
    best_.upper = 0;
    for (const SweptArc& a : a_.arcs())
      for (const SweptArc& b : b_.arcs())
        for (const bool in_a : {true, false})
          if (!(in_a ? a_ : b_).flat())
            evaluate({a, b, std::numeric_limits<double>::infinity(), in_a, 0});
    while (!open_.empty()) {
      const ArcPair cell = open_.top();
      best_.upper = std::max({best_.lower, cell.bound, settled_});
      if (best_.upper - best_.lower <= kTorusDepthTolerance) return best_;
      if (count_ >= kMaxDepthCells) {
        best_.complete = false;
        return best_;
      }
      open_.pop();
      for (const ArcPair& half : split_arc_pair(a_, b_, cell)) evaluate(half);
    }
    best_.upper = std::max(best_.lower, settled_);
    return best_;
  }
  [[nodiscard]] bool deep_in_a() const { return deep_in_a_; }

 private:
  [[nodiscard]] DeepestPoint measure(const ArcPair& cell) const {
    const PrimitiveOperand &in = cell.in_a ? a_ : b_, &other = cell.in_a ? b_ : a_;
    const SweptArc &arc = cell.in_a ? cell.a : cell.b, &beside = cell.in_a ? cell.b : cell.a;
    const auto from_domain = [&](const auto& measured) {
      if (other.torus)
        return maximise_depth(measured, TorusArcDomain(*other.torus, beside), best_.lower);
      return maximise_depth(measured, ConvexDomain{*other.convex}, best_.lower);
    };
    if (in.torus) return from_domain(TorusArcInterior(*in.torus, arc));
    return from_domain(ConvexDepthOracle(*in.convex, *in.field));
  }

  void evaluate(ArcPair cell) {
    ++count_;
    const DeepestPoint found = measure(cell);
    if (found.lower > best_.lower) {
      best_.lower = found.lower;
      best_.point = found.point;
      deep_in_a_ = cell.in_a;
    }
    cell.bound = std::min(cell.bound, found.upper);
    cell.id = count_;
    // A pair no deeper than the tolerance allows, or that cannot be split, is settled.
    if (cell.bound > best_.lower + kTorusDepthTolerance &&
        a_.hull_error(cell.a) + b_.hull_error(cell.b) > 0)
      open_.push(cell);
    else
      settled_ = std::max(settled_, cell.bound);
  }

  const PrimitiveOperand &a_, &b_;
  DeepestPoint best_;
  bool deep_in_a_ = true;
  double settled_ = 0;  ///< the greatest bound of settled pairs
  std::size_t count_ = 0;
  std::priority_queue<ArcPair, std::vector<ArcPair>, GreaterDepthFirst> open_;
};

}  // namespace strake::geometry::primitive_pairs
