// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <queue>
#include <vector>

#include "geometry/analytic/convex_depth.hpp"
#include "geometry/analytic/pair_side.hpp"
#include "geometry/analytic/torus_depth.hpp"
#include "geometry/analytic/torus_gap.hpp"

namespace strake::geometry::analytic {

/// Work limit: the bracket is certain wherever it stops the search.
inline constexpr std::size_t kMaxDepths = 300;
/// Grid units: brackets this narrow are narrow enough.
inline constexpr double kTorusDepth = 0.25;

struct DeeperFirst {
  bool operator()(const Cell& x, const Cell& y) const {
    return x.bound != y.bound ? x.bound < y.bound : x.id > y.id;
  }
};

/// Best first over pairs of arcs and both bodies: cutting planes bound each.
class DepthSearch {
 public:
  DepthSearch(const PairSide& a, const PairSide& b) : a_(a), b_(b) {}

  DeepestPoint run() {
    best_.upper = 0;
    for (const Arc& a : a_.arcs())
      for (const Arc& b : b_.arcs())
        for (const bool in_a : {true, false})
          if (!(in_a ? a_ : b_).flat())
            evaluate({a, b, std::numeric_limits<double>::infinity(), in_a, 0});
    while (!open_.empty()) {
      const Cell cell = open_.top();
      best_.upper = std::max({best_.lower, cell.bound, settled_});
      if (best_.upper - best_.lower <= kTorusDepth) return best_;
      if (count_ >= kMaxDepths) {
        best_.complete = false;
        return best_;
      }
      open_.pop();
      for (const Cell& half : halves(a_, b_, cell)) evaluate(half);
    }
    best_.upper = std::max(best_.lower, settled_);
    return best_;
  }
  [[nodiscard]] bool deep_in_a() const { return deep_in_a_; }

 private:
  [[nodiscard]] DeepestPoint measure(const Cell& cell) const {
    const PairSide &in = cell.in_a ? a_ : b_, &other = cell.in_a ? b_ : a_;
    const Arc &arc = cell.in_a ? cell.a : cell.b, &beside = cell.in_a ? cell.b : cell.a;
    const auto from_room = [&](const auto& measured) {
      if (other.torus) return deepest(measured, TorusRoom(*other.torus, beside), best_.lower);
      return deepest(measured, ConvexRoom{*other.convex}, best_.lower);
    };
    if (in.torus) return from_room(TorusPiece(*in.torus, arc));
    return from_room(DeepBody(*in.convex, *in.field));
  }

  void evaluate(Cell cell) {
    ++count_;
    const DeepestPoint found = measure(cell);
    if (found.lower > best_.lower) {
      best_.lower = found.lower;
      best_.point = found.point;
      deep_in_a_ = cell.in_a;
    }
    cell.bound = std::min(cell.bound, found.upper);
    cell.id = count_;
    // What is no deeper than the tolerance allows, and what cannot be cut, is done with.
    if (cell.bound > best_.lower + kTorusDepth && a_.slack(cell.a) + b_.slack(cell.b) > 0)
      open_.push(cell);
    else
      settled_ = std::max(settled_, cell.bound);
  }

  const PairSide &a_, &b_;
  DeepestPoint best_;
  bool deep_in_a_ = true;
  double settled_ = 0;  ///< the greatest bound of what is done with
  std::size_t count_ = 0;
  std::priority_queue<Cell, std::vector<Cell>, DeeperFirst> open_;
};

}  // namespace strake::geometry::analytic
