// SPDX-License-Identifier: Apache-2.0
#include "geometry/analytic/torus_pair.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <queue>
#include <vector>

#include "geometry/analytic/convex_depth.hpp"
#include "geometry/analytic/inside.hpp"
#include "geometry/analytic/pair_side.hpp"
#include "geometry/analytic/torus_depth.hpp"
#include "geometry/analytic/torus_gap.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::geometry::analytic {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
/// Work limit: the bracket is certain wherever it stops the search.
constexpr std::size_t kMaxDepths = 300;
/// Grid units: brackets this narrow are narrow enough.
constexpr double kTorusDepth = 0.25;

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
          if (!(in_a ? a_ : b_).flat()) evaluate({a, b, kNever, in_a, 0});
    while (!open_.empty()) {
      const Cell cell = open_.top();
      best_.upper = std::max({best_.lower, cell.bound, settled_});
      if (best_.upper - best_.lower <= kTorusDepth || count_ >= kMaxDepths) return best_;
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
    // What is no deeper than the tolerance allows is done with.
    if (cell.bound > best_.lower + kTorusDepth)
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

/// How deep the hulls of a body's arcs lie in the other; see inside_by.
double inside(const PairSide& inner, const PairSide& outer) {
  double least = kNever;
  for (const Arc& arc : inner.arcs()) {
    const ConvexBody hull = inner.hull(arc);
    if (outer.field) {
      least = std::min(least, inside_by(hull, *outer.convex, *outer.field));
      continue;
    }
    if (!outer.torus) return -kNever;
    for (int x = -2; x <= 2; ++x)
      for (int y = -2; y <= 2; ++y)
        for (int z = -2; z <= 2; ++z) {
          const Vec3d n = outer.torus->turned({x * 1.0, y * 1.0, z * 1.0});
          least = std::min(least, outer.torus->depth(inner.real(support(hull.shape, n))));
        }
  }
  return least;
}

AnalyticSeparation bracket(double lower, double upper) {
  AnalyticSeparation s;
  s.d = (lower + upper) / 2;
  s.error = (upper - lower) / 2;
  s.a_inside_b = s.b_inside_a = -s.d;
  s.difference = kNever;
  return s;
}

AnalyticSeparation apart(const ConvexGap& gap, double lower, double upper) {
  AnalyticSeparation s = bracket(lower, upper);
  s.point = (gap.on_a + gap.on_b) * 0.5;
  const Vec3d way = gap.on_a - gap.on_b;
  const double length = norm(way);
  s.away = length > gap.upper / 2 ? way * (1 / length) : gap.normal;
  return s;
}

AnalyticSeparation meeting(const PairSide& a, const PairSide& b, const ConvexGap& gap) {
  DepthSearch search(a, b);
  const DeepestPoint depth = search.run();
  if (!(depth.lower > 0)) return apart(gap, -depth.upper, std::max(gap.upper, -depth.upper));
  AnalyticSeparation s = bracket(-depth.upper, -depth.lower);
  s.point = depth.point;
  s.deep_in_a = search.deep_in_a();
  const PairSide& in = s.deep_in_a ? a : b;
  const Vec3d out =
      in.torus ? in.torus->way_out(depth.point) : in.field->nearest(depth.point).normal;
  s.away = s.deep_in_a ? -out : out;
  s.a_inside_b = inside(a, b);
  s.b_inside_a = inside(b, a);
  if (!a.flat() && !b.flat()) s.difference = std::max(-s.a_inside_b, -s.b_inside_a);
  return s;
}

}  // namespace

std::optional<AnalyticSeparation> torus_separation(const PlacedPrimitive& a,
                                                   const PlacedPrimitive& b, double enough) {
  const auto origin = snap(a.placement->translation);
  PairSide x, y;
  if (!origin || !x.read(a, *origin) || !y.read(b, *origin) || !(x.torus || y.torus))
    return std::nullopt;
  GapSearch search(x, y, enough);
  const ConvexGap gap = search.run();
  if (gap.lower > 0) {
    AnalyticSeparation s = apart(gap, gap.lower, gap.lower >= enough ? gap.lower : gap.upper);
    s.sheet_a = x.flat();
    s.sheet_b = y.flat();
    return s;
  }
  if (x.flat() || y.flat() || (x.convex && !x.field) || (y.convex && !y.field)) return std::nullopt;
  if (gap.upper <= kTouch) {
    const double touch = search.touch_bound();
    if (touch >= -kTouch) return apart(gap, std::min(touch, gap.upper), gap.upper);
  }
  return meeting(x, y, gap);
}

}  // namespace strake::geometry::analytic
