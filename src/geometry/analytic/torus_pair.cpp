// SPDX-License-Identifier: Apache-2.0
#include "geometry/analytic/torus_pair.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <queue>
#include <vector>

#include "geometry/analytic/convex_depth.hpp"
#include "geometry/analytic/convex_gap.hpp"
#include "geometry/analytic/inside.hpp"
#include "geometry/analytic/pair_side.hpp"
#include "geometry/analytic/torus_depth.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::geometry::analytic {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
/// Work limits: the bracket is certain wherever they stop the search.
constexpr std::size_t kMaxGaps = 600, kMaxDepths = 300;
/// Grid units: brackets this narrow are narrow enough.
constexpr double kTorusGap = 0.1, kTorusDepth = 0.25;
/// Grid units: see Meeting in convex_pair.cpp.
constexpr double kTouch = 1;

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
struct DeeperFirst {
  bool operator()(const Cell& x, const Cell& y) const {
    return x.bound != y.bound ? x.bound < y.bound : x.id > y.id;
  }
};

/// The two halves of a cell, cut where its hulls stand off the most.
std::array<Cell, 2> halves(const PairSide& a, const PairSide& b, const Cell& cell) {
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
      for (const Arc& b : b_.arcs()) evaluate({a, b, -kNever, false, 0});
    while (!open_.empty()) {
      const Cell cell = open_.top();
      best_.lower = cell.bound;
      if (finished() || count_ >= kMaxGaps) return best_;
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
    if (gap.upper < kNever) improve(gap);
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
    double widest = -kNever;
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
  double most_parted_ = -kNever;
  std::size_t count_ = 0;
  std::priority_queue<Cell, std::vector<Cell>, NearerFirst> open_;
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
