// SPDX-License-Identifier: Apache-2.0
#include "clash/curves.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "clash/canonical_order.hpp"
#include "clash/pair_limits.hpp"
#include "clash/witness.hpp"
#include "strake/geometry/thin_pair.hpp"

namespace strake::clash {
namespace {

using geometry::Part;
using geometry::PartKind;
using geometry::ThinSeparation;
using geometry::Vec3d;

/// Below this a direction between two points is the rounding of both, grid units.
constexpr double kLeastLength = 1.0 / 64;

bool is_wire(const NarrowPart& p) { return p.treed.placed.part->kind == PartKind::wire; }

/// The same lines in the same place.
bool equal_wires(const NarrowPart& a, const NarrowPart& b) {
  const Part &x = *a.treed.placed.part, &y = *b.treed.placed.part;
  return a.treed.placed.origin == b.treed.placed.origin && x.vertices == y.vertices &&
         x.chain_first == y.chain_first;
}

/// What was measured, and how far what it was measured on may lie from the true surface.
struct Measured {
  ThinSeparation separation;
  double sag = 0;
};

Measured measure(const NarrowPart& wire, const NarrowPart& body, const NarrowOptions& options,
                 double overlap, NarrowWork& work) {
  const double reach = reach_of(options);
  const geometry::ThinBody thin = geometry::thin_wire(wire.treed.placed);
  if (is_wire(body))
    return {thin_separation(thin, geometry::thin_wire(body.treed.placed), reach), 0};
  const Part& part = *body.treed.placed.part;
  // Triangles that are the true surface are compared exactly.
  if (part.primitive && body.placement != nullptr && part.kind == PartKind::solid && part.sag > 0)
    if (const auto s = thin_separation(thin, {&*part.primitive, body.placement}, reach))
      return {*s, 0};
  geometry::DepthGoal goal;
  goal.threshold = overlap;
  return {thin_separation(thin, body.treed, goal, work.pair, reach + part.sag), part.sag};
}

Witness witness_of(const ThinSeparation& s, bool in_solid) {
  const Vec3d way = s.inside ? s.on_other - s.on_thin : s.on_thin - s.on_other;
  const double length = std::sqrt(dot(way, way));
  Witness w{.on_a = s.on_thin, .on_b = s.on_other, .interiors_meet = s.inside};
  if (length >= kLeastLength && (in_solid || !s.inside)) w.away = way * (1 / length);
  return w;
}

Relation relation_of(const ThinSeparation& s, const NarrowPart& wire, const NarrowPart& body,
                     double band) {
  if (is_wire(body) && equal_wires(wire, body)) return Relation::duplicate;
  if (std::fabs(s.d) <= band) return Relation::abut_outside;
  if (s.d > 0) return Relation::separate;
  return s.wholly_inside > band ? Relation::a_in_b : Relation::cross;
}

/// The wire first.
PartAnswer judge_ordered(const NarrowPart& wire, const NarrowPart& body,
                         const NarrowOptions& options, NarrowWork& work) {
  const Part &x = *wire.treed.placed.part, &y = *body.treed.placed.part;
  const Thresholds limits = thresholds(x, y, options);
  const Measured m = measure(wire, body, options, limits.overlap, work);
  const ThinSeparation& s = m.separation;
  PartAnswer answer;
  answer.separation = {.d = s.d,
                       .lower = s.lower,
                       .upper = s.upper,
                       .sag = m.sag,
                       .moved = options.snap + options.step,
                       .interiors_meet = s.inside,
                       .depth_complete = s.depth_complete};
  answer.witness = witness_of(s, y.kind == PartKind::solid);
  answer.relation = relation_of(s, wire, body, options.contact_distance);
  answer.judgement = judge(answer.separation, limits);
  answer.judgement.flags |= part_flags(x, y);
  return answer;
}

}  // namespace

bool has_wire(const Part& a, const Part& b) {
  return a.kind == PartKind::wire || b.kind == PartKind::wire;
}

PartAnswer judge_wire(const NarrowPart& a, const NarrowPart& b, const NarrowOptions& options,
                      NarrowWork& work) {
  if (is_wire(a) && is_wire(b))
    return in_order(a, b, [&](const NarrowPart& x, const NarrowPart& y) {
      return judge_ordered(x, y, options, work);
    });
  PartAnswer answer =
      is_wire(a) ? judge_ordered(a, b, options, work) : judge_ordered(b, a, options, work);
  put_in_steps(answer);
  if (!is_wire(a)) turn(answer, a, b);
  return answer;
}

}  // namespace strake::clash
