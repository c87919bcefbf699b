// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>

#include "geometry/analytic/bracket.hpp"
#include "geometry/analytic/depth_search.hpp"
#include "geometry/analytic/inside.hpp"
#include "geometry/analytic/torus_gap.hpp"
#include "geometry/thin/pieces.hpp"
#include "strake/geometry/thin_pair.hpp"

namespace strake::geometry {
namespace {

using analytic::ConvexGap;
using analytic::DeepestPoint;
using analytic::PairSide;
using thin::ExactLeast;
using thin::LeastGap;
using thin::Piece;
using thin::Pieces;

/// Adds the distance of two sides unless it is certainly not the least.
void add_gap(const PairSide& a, const PairSide& b, double enough, LeastGap& least) {
  const ConvexGap gap = analytic::GapSearch(a, b, std::min(enough, least.upper)).run();
  least.add(gap.lower, gap.upper, gap.on_a, gap.on_b);
}

ThinSeparation apart(const LeastGap& gap, double lower, double enough) {
  ThinSeparation s;
  s.lower = lower;
  s.upper = gap.lower >= enough ? gap.lower : gap.upper;
  s.d = analytic::shown(s.lower, s.upper, 0);
  s.on_thin = gap.on_a;
  s.on_other = gap.on_b;
  return s;
}

/// The deepest point of a thin body in a primitive, over the pieces that may meet it.
struct Deepest {
  double lower = 0, upper = 0;
  Vec3d point;
  bool complete = true;

  void add(const DeepestPoint& found) {
    complete = complete && found.complete;
    upper = std::max(upper, found.upper);
    if (!(found.lower > lower)) return;
    lower = found.lower;
    point = found.point;
  }
};

ThinSeparation meeting(const Deepest& deepest, const PairSide& primitive) {
  ThinSeparation s;
  s.lower = -deepest.upper;
  s.upper = -deepest.lower;
  s.d = analytic::shown(s.lower, s.upper, analytic::kTorusDepth);
  s.inside = true;
  s.on_thin = deepest.point;
  const Vec3d out = primitive.torus ? primitive.torus->way_out(deepest.point)
                                    : primitive.field->nearest(deepest.point).normal;
  s.on_other = deepest.point - out * s.d;
  return s;
}

double wholly_inside(const Pieces& pieces, const PairSide& body) {
  double least = std::numeric_limits<double>::infinity();
  for (const Piece& piece : pieces.simplices)
    least = std::min(least, analytic::inside_by(piece.side(), body));
  for (const PairSide& arc : pieces.arcs) least = std::min(least, analytic::inside_by(arc, body));
  return least;
}

}  // namespace

ThinSeparation thin_separation(const ThinBody& a, const ThinBody& b, double enough) {
  const Pieces x(a, a.origin), y(b, a.origin);
  ExactLeast exact;
  for (const Piece& p : x.simplices)
    for (const Piece& q : y.simplices)
      if (!exact.beyond(squared_gap(p.box, q.box))) exact.offer(p.corners(), q.corners());
  LeastGap least;
  least.add(exact);
  for (const PairSide& arc : x.arcs) {
    for (const Piece& q : y.simplices) add_gap(arc, q.side(), enough, least);
    for (const PairSide& other : y.arcs) add_gap(arc, other, enough, least);
  }
  for (const PairSide& arc : y.arcs)
    for (const Piece& p : x.simplices) add_gap(p.side(), arc, enough, least);
  ThinSeparation s = apart(least, std::max(0.0, least.lower), enough);
  if (exact.touching()) s.lower = s.upper = s.d = 0;
  return s;
}

std::optional<ThinSeparation> thin_separation(const ThinBody& thin,
                                              const PlacedPrimitive& primitive, double enough) {
  PairSide body;
  if (!body.read(primitive, thin.origin)) return std::nullopt;
  const bool solid = !body.flat();
  if (solid && body.convex && !body.field) return std::nullopt;
  const Pieces pieces(thin, thin.origin);
  LeastGap least;
  Deepest deepest;
  bool meets = false;
  const auto measure = [&](const PairSide& piece) {
    const double reach = std::min(enough, std::max(least.upper, 0.0));
    const ConvexGap gap = analytic::GapSearch(piece, body, reach).run();
    least.add(gap.lower, gap.upper, gap.on_a, gap.on_b);
    if (gap.lower > 0 || !solid) return;
    meets = true;
    deepest.add(analytic::DepthSearch(piece, body).run());
  };
  for (const Piece& piece : pieces.simplices) measure(piece.side());
  for (const PairSide& arc : pieces.arcs) measure(arc);
  if (!meets) return apart(least, std::max(0.0, least.lower), enough);
  // Without a point inside a touch, as far as this can tell.
  ThinSeparation s = deepest.lower > 0
                         ? meeting(deepest, body)
                         : apart(least, std::min(-deepest.upper, least.upper), enough);
  if (deepest.lower > 0) s.wholly_inside = wholly_inside(pieces, body);
  s.depth_complete = deepest.complete;
  return s;
}

}  // namespace strake::geometry
