// SPDX-License-Identifier: Apache-2.0
#include "clash/narrow_phase/wire_clash.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "clash/narrow_phase/canonical_order.hpp"
#include "clash/narrow_phase/pair_tolerances.hpp"
#include "clash/narrow_phase/witness.hpp"
#include "strake/geometry/lower_dimensional_separation.hpp"

namespace strake::clash {
namespace {

using geometry::LowerDimensionalSeparation;
using geometry::Part;
using geometry::PartKind;
using geometry::Vec3d;

/// A distance below this is rounding, grid units: it gives no direction between two points.
constexpr double kMinWireLength = 1.0 / 64;

bool is_wire(const PairOperand& p) { return p.treed.placed.part->kind == PartKind::wire; }

/// Whether both parts are the same lines in the same place.
bool equal_wires(const PairOperand& a, const PairOperand& b) {
  const Part &x = *a.treed.placed.part, &y = *b.treed.placed.part;
  return a.treed.placed.origin == b.treed.placed.origin && x.vertices == y.vertices &&
         x.chain_first == y.chain_first;
}

/// A measured separation, and how far what it was measured on may lie from the true surface.
struct WireMeasure {
  LowerDimensionalSeparation separation;
  double sag = 0;
};

WireMeasure measure(const PairOperand& wire, const PairOperand& body, const PairTolerances& options,
                    double overlap, NarrowWork& work) {
  const double reach = reach_of(options);
  const geometry::LowerDimensionalBody thin = geometry::make_wire_body(wire.treed.placed);
  if (is_wire(body))
    return {lower_dimensional_separation(thin, geometry::make_wire_body(body.treed.placed), reach),
            0};
  const Part& part = *body.treed.placed.part;
  // Triangles that are the true surface are compared exactly.
  if (part.primitive && body.placement != nullptr && part.kind == PartKind::solid && part.sag > 0)
    if (const auto s =
            lower_dimensional_separation(thin, {&*part.primitive, body.placement}, reach))
      return {*s, 0};
  geometry::DepthOptions goal;
  goal.threshold = overlap;
  return {lower_dimensional_separation(thin, body.treed, goal, work.pair, reach + part.sag),
          part.sag};
}

Witness witness_of(const LowerDimensionalSeparation& s, bool in_solid) {
  const Vec3d way = s.inside ? s.on_other - s.on_body : s.on_body - s.on_other;
  const double length = std::sqrt(dot(way, way));
  Witness w{.on_a = s.on_body, .on_b = s.on_other, .interiors_meet = s.inside};
  if (length >= kMinWireLength && (in_solid || !s.inside)) w.away = way * (1 / length);
  return w;
}

Relation relation_of(const LowerDimensionalSeparation& s, const PairOperand& wire,
                     const PairOperand& body, double band) {
  if (is_wire(body) && equal_wires(wire, body)) return Relation::duplicate;
  if (std::fabs(s.d) <= band) return Relation::abut_outside;
  if (s.d > 0) return Relation::separate;
  return s.wholly_inside > band ? Relation::a_in_b : Relation::cross;
}

/// Evaluates a pair with the wire first.
PartPairResult evaluate_ordered_wire(const PairOperand& wire, const PairOperand& body,
                                     const PairTolerances& options, NarrowWork& work) {
  const Part &x = *wire.treed.placed.part, &y = *body.treed.placed.part;
  const Thresholds limits = thresholds(x, y, options);
  const WireMeasure m = measure(wire, body, options, limits.overlap, work);
  const LowerDimensionalSeparation& s = m.separation;
  PartPairResult answer;
  answer.separation = {.d = s.d,
                       .lower = s.lower,
                       .upper = s.upper,
                       .sag = m.sag,
                       .moved = options.snap + options.step,
                       .interiors_meet = s.inside,
                       .depth_complete = s.depth_complete};
  answer.witness = witness_of(s, y.kind == PartKind::solid);
  answer.relation = relation_of(s, wire, body, options.contact_distance);
  answer.classification = classify(answer.separation, limits);
  answer.classification.flags |= part_flags(x, y);
  return answer;
}

}  // namespace

bool has_wire(const Part& a, const Part& b) {
  return a.kind == PartKind::wire || b.kind == PartKind::wire;
}

PartPairResult evaluate_wire(const PairOperand& a, const PairOperand& b,
                             const PairTolerances& options, NarrowWork& work) {
  if (is_wire(a) && is_wire(b))
    return evaluate_in_canonical_order(a, b, [&](const PairOperand& x, const PairOperand& y) {
      return evaluate_ordered_wire(x, y, options, work);
    });
  PartPairResult answer = is_wire(a) ? evaluate_ordered_wire(a, b, options, work)
                                     : evaluate_ordered_wire(b, a, options, work);
  round_to_witness_grid(answer);
  if (!is_wire(a)) swap_sides(answer, a, b);
  return answer;
}

}  // namespace strake::clash
