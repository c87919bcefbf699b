// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/lower_dimensional_separation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/bvh/pair_local_part.hpp"
#include "geometry/bvh/traversal.hpp"
#include "geometry/interior_depth/sheets/simplex_depth_search.hpp"
#include "geometry/lower_dimensional/body_simplices.hpp"
#include "geometry/lower_dimensional/sheet_piercing.hpp"
#include "geometry/primitive_pairs/mesh_distance.hpp"
#include "geometry/primitive_pairs/separation_bracket.hpp"
#include "geometry/primitive_pairs/solvers/containment_depth.hpp"
#include "geometry/primitive_pairs/solvers/torus_branch_and_bound.hpp"

namespace strake::geometry {
namespace {

using lower_dimensional::BodySimplex;
using lower_dimensional::BodySimplices;
using lower_dimensional::ExactMinDistance;
using lower_dimensional::MinDistanceBracket;
using primitive_pairs::DeepestPoint;
using primitive_pairs::GjkResult;
using primitive_pairs::PrimitiveOperand;

/// Adds the distance of two operands unless it is certainly not the least.
void add_gap(const PrimitiveOperand& a, const PrimitiveOperand& b, double cutoff,
             MinDistanceBracket& least) {
  const GjkResult gap =
      primitive_pairs::TorusDistanceSearch(a, b, std::min(cutoff, least.upper)).run();
  least.add(gap.lower, gap.upper, gap.on_a, gap.on_b);
}

LowerDimensionalSeparation apart(const MinDistanceBracket& gap, double lower, double cutoff) {
  LowerDimensionalSeparation s;
  s.lower = lower;
  s.upper = gap.lower >= cutoff ? gap.lower : gap.upper;
  s.d = primitive_pairs::nominal_separation(s.lower, s.upper, 0);
  s.on_body = gap.on_a;
  s.on_other = gap.on_b;
  return s;
}

/// The deepest point of a body without thickness in a primitive, over the simplices that may meet
/// it.
struct DeepestOfSimplices {
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

LowerDimensionalSeparation meeting(const DeepestOfSimplices& deepest,
                                   const PrimitiveOperand& primitive) {
  LowerDimensionalSeparation s;
  s.lower = -deepest.upper;
  s.upper = -deepest.lower;
  s.d =
      primitive_pairs::nominal_separation(s.lower, s.upper, primitive_pairs::kTorusDepthTolerance);
  s.inside = true;
  s.on_body = deepest.point;
  const Vec3d out = primitive.torus ? primitive.torus->exit_direction(deepest.point)
                                    : primitive.field->nearest(deepest.point).normal;
  s.on_other = deepest.point - out * s.d;
  return s;
}

double wholly_inside(const BodySimplices& pieces, const PrimitiveOperand& body) {
  double least = std::numeric_limits<double>::infinity();
  for (const BodySimplex& piece : pieces.simplices)
    least = std::min(least, primitive_pairs::containment_depth(piece.side(), body));
  for (const PrimitiveOperand& arc : pieces.arcs)
    least = std::min(least, primitive_pairs::containment_depth(arc, body));
  return least;
}

}  // namespace

LowerDimensionalSeparation lower_dimensional_separation(const LowerDimensionalBody& a,
                                                        const LowerDimensionalBody& b,
                                                        double cutoff) {
  const BodySimplices x(a, a.origin), y(b, a.origin);
  ExactMinDistance exact;
  for (const BodySimplex& p : x.simplices)
    for (const BodySimplex& q : y.simplices)
      if (!exact.beyond(squared_gap(p.box, q.box))) exact.offer(p.corners(), q.corners());
  MinDistanceBracket least;
  least.add(exact);
  for (const PrimitiveOperand& arc : x.arcs) {
    for (const BodySimplex& q : y.simplices) add_gap(arc, q.side(), cutoff, least);
    for (const PrimitiveOperand& other : y.arcs) add_gap(arc, other, cutoff, least);
  }
  for (const PrimitiveOperand& arc : y.arcs)
    for (const BodySimplex& p : x.simplices) add_gap(p.side(), arc, cutoff, least);
  LowerDimensionalSeparation s = apart(least, std::max(0.0, least.lower), cutoff);
  if (exact.touching()) s.lower = s.upper = s.d = 0;
  return s;
}

std::optional<LowerDimensionalSeparation> lower_dimensional_separation(
    const LowerDimensionalBody& thin, const PlacedPrimitive& primitive, double cutoff) {
  PrimitiveOperand body;
  if (!body.read(primitive, thin.origin)) return std::nullopt;
  const bool solid = !body.flat();
  if (solid && body.convex && !body.field) return std::nullopt;
  const BodySimplices pieces(thin, thin.origin);
  MinDistanceBracket least;
  DeepestOfSimplices deepest;
  bool meets = false;
  const auto measure = [&](const PrimitiveOperand& piece) {
    const double reach = std::min(cutoff, std::max(least.upper, 0.0));
    const GjkResult gap = primitive_pairs::TorusDistanceSearch(piece, body, reach).run();
    least.add(gap.lower, gap.upper, gap.on_a, gap.on_b);
    if (gap.lower > 0 || !solid) return;
    meets = true;
    deepest.add(primitive_pairs::TorusDepthSearch(piece, body).run());
  };
  for (const BodySimplex& piece : pieces.simplices) measure(piece.side());
  for (const PrimitiveOperand& arc : pieces.arcs) measure(arc);
  if (!meets) return apart(least, std::max(0.0, least.lower), cutoff);
  // Without a point inside a touch, as far as this can tell.
  LowerDimensionalSeparation s = deepest.lower > 0
                                     ? meeting(deepest, body)
                                     : apart(least, std::min(-deepest.upper, least.upper), cutoff);
  if (deepest.lower > 0) s.wholly_inside = wholly_inside(pieces, body);
  s.depth_complete = deepest.complete;
  return s;
}

namespace {

using primitive_pairs::Torus;

/// Grid units: farther from the surface than this, the grid point next to a point is on its side.
constexpr double kSnap = 2;
/// Maximum number of chords of a quarter circle.
constexpr int kMaxChords = 1024;

/// The decisions are exact.
void add_piece(const BodySimplex& piece, const PartWithBvh& mesh, double cutoff,
               ExactMinDistance& least) {
  const auto& nodes = mesh.tree->nodes();
  const PairLocalPart view(mesh, {});
  traverse_nearest_first(
      *mesh.tree,
      [&](std::uint32_t i) { return squared_gap(piece.box, nodes[i].box.as<double>()); },
      [&](double squared) {
        return least.touching() || least.beyond(squared) ||
               std::sqrt(squared) * (1 - 1e-14) > cutoff;
      },
      [&](std::uint32_t t) { least.offer(piece.corners(), view.corners(t)); });
}

/// Chords of an arc, and how far it stands off them.
struct Chords {
  std::vector<std::array<Vec3d, 2>> segments;
  double sagitta = 0;

  explicit Chords(const Torus& arc) {
    const double radius = arc.profile().centre;
    for (const primitive_pairs::SweptArc& quarter : arc.arcs()) {
      const double angle = quarter.to - quarter.from;
      // A sagitta of half a unit: radius·step²/8.
      const double wanted = std::ceil(angle * std::sqrt(radius) / 2);
      const int count = std::max(1, static_cast<int>(std::min<double>(wanted, kMaxChords)));
      const double step = angle / count;
      sagitta = std::max(sagitta, radius * step * step / 8);
      const auto at = [&](int i) {
        const SinCos s = sin_cos(quarter.from + step * i);
        return arc.centre() + arc.turned({radius * s.cos, radius * s.sin, 0});
      };
      for (int i = 0; i < count; ++i) segments.push_back({at(i), at(i + 1)});
    }
    sagitta += arc.error();
  }
};

/// The simplices of a body without thickness that may lie in a solid, measured by the depth search.
class SimplexDepths {
 public:
  SimplexDepths(const PartWithBvh& mesh, const DepthOptions& goal, QueryContext& work)
      : mesh_(mesh), field_(mesh, {}), goal_(goal), work_(work) {
    const Box3i& box = mesh.placed.part->box;
    margin_ = kFieldError * 4 * (1 + length((box.hi - box.lo).as<double>()));
  }

  void add(const BodySimplex& piece) {
    const auto at = [&](std::size_t i) {
      return piece.corner[std::min(i, piece.count - 1)].as<double>();
    };
    if (piece.count == 3) {
      const std::array<std::array<Vec3d, 3>, 1> triangle{{{at(0), at(1), at(2)}}};
      measure<3>(triangle, 0);
    } else {
      const std::array<std::array<Vec3d, 2>, 1> segment{{{at(0), at(1)}}};
      measure<2>(segment, 0);
    }
  }
  void add(const Torus& arc) {
    const Chords chords(arc);
    measure<2>(chords.segments, chords.sagitta);
  }
  [[nodiscard]] const Depth& result() const { return best_; }
  [[nodiscard]] bool holds(const Vec3l& p) const {
    return side_of(mesh_, p, 1, work_) != PointSide::outside;
  }

 private:
  template <std::size_t N>
  void measure(std::span<const std::array<Vec3d, N>> pieces, double off) {
    Depth depth;
    depth.upper = std::numeric_limits<double>::infinity();
    depth.value = depth.lower = best_.value;
    SimplexDepthSearch<N>(pieces, field_, goal_, depth, margin_, work_).run();
    best_.upper = std::max({best_.upper, depth.upper + off, depth.value});
    best_.cells += depth.cells;
    best_.complete = best_.complete && depth.complete;
    if (!(depth.value > best_.value)) return;
    best_.value = depth.value;
    best_.lower = std::max(best_.lower, depth.lower - off);
    best_.point = depth.point;
  }

  const PartWithBvh& mesh_;
  DistanceField field_;
  const DepthOptions& goal_;
  QueryContext& work_;
  double margin_ = 0;
  Depth best_;
};

/// Returns the separation from a solid, from the distance to its surface and the depth.
LowerDimensionalSeparation in_solid(const MinDistanceBracket& gap, const Depth& depth,
                                    const PartWithBvh& mesh) {
  LowerDimensionalSeparation s;
  s.depth_complete = depth.complete;
  if (depth.lower > 0) {
    s.d = -depth.value;
    s.lower = -depth.upper;
    s.upper = -depth.lower;
    s.inside = true;
    s.on_body = depth.point;
    s.on_other = nearest_on_surface(mesh, depth.point).point;
    return s;
  }
  s.lower = -depth.upper;
  s.upper = gap.upper;
  s.on_body = gap.on_a;
  s.on_other = gap.on_b;
  return s;
}

LowerDimensionalSeparation through_sheet(const lower_dimensional::SheetPiercing& crossing) {
  // Roundings of a point and of a distance to a segment.
  const double error = kFieldError * crossing.depth + 1e-6;
  LowerDimensionalSeparation s;
  s.d = -crossing.depth;
  s.lower = s.d - error;
  s.upper = std::min(0.0, s.d + error);
  s.inside = s.upper < 0;
  s.on_body = s.on_other = crossing.point;
  return s;
}

}  // namespace

LowerDimensionalSeparation lower_dimensional_separation(const LowerDimensionalBody& thin,
                                                        const PartWithBvh& mesh,
                                                        const DepthOptions& goal,
                                                        QueryContext& work, double cutoff) {
  const BodySimplices pieces(thin, mesh.placed.origin);
  const bool solid = mesh.placed.part->kind == PartKind::solid;
  const Vec3d back = (mesh.placed.origin - thin.origin).as<double>();
  ExactMinDistance exact;
  MinDistanceBracket least;
  SimplexDepths depth(mesh, goal, work);
  bool meets = false, all_within = true;
  for (const BodySimplex& piece : pieces.simplices) {
    ExactMinDistance own;
    add_piece(piece, mesh, cutoff, solid ? own : exact);
    if (!solid) continue;
    least.add(own);
    const bool within = !own.touching() && depth.holds(piece.corner[0]);
    all_within = all_within && within;
    if (!own.touching() && !within) continue;
    meets = true;
    depth.add(piece);
  }
  least.add(exact);
  for (const PrimitiveOperand& arc : pieces.arcs) {
    const PrimitiveMeshDistance gap =
        primitive_pairs::operand_mesh_distance(arc, mesh, std::min(cutoff, least.upper));
    least.add(gap.lower, gap.upper, gap.on_primitive, gap.on_mesh);
    if (!solid) continue;
    const Vec3d start = arc.torus->nearest(arc.torus->centre());
    const Vec3l near{std::llround(start.x), std::llround(start.y), std::llround(start.z)};
    const bool within = gap.lower > kSnap && depth.holds(near);
    all_within = all_within && within;
    if (gap.lower > kSnap && !within) continue;
    meets = true;
    depth.add(*arc.torus);
  }
  const lower_dimensional::SheetPiercing crossing =
      exact.touching() && !solid ? lower_dimensional::deepest_piercing(thin, mesh)
                                 : lower_dimensional::SheetPiercing{};
  LowerDimensionalSeparation s;
  if (crossing.depth > 0) {
    s = through_sheet(crossing);
  } else if (meets) {
    s = in_solid(least, depth.result(), mesh);
    // A body farther from the surface than the limit is no less inside.
    if (s.inside && all_within) s.wholly_inside = std::min(least.lower, -s.d);
  } else {
    s.lower = std::max(0.0, std::min(least.lower, cutoff));
    s.upper = std::min(least.upper, s.lower < cutoff ? least.upper : s.lower);
    s.on_body = least.on_a;
    s.on_other = least.on_b;
    s.d = (s.lower + s.upper) / 2;
  }
  s.on_body = s.on_body + back;
  s.on_other = s.on_other + back;
  return s;
}

}  // namespace strake::geometry
