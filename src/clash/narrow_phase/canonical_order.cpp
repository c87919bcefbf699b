// SPDX-License-Identifier: Apache-2.0
#include "clash/narrow_phase/canonical_order.hpp"

#include "clash/narrow_phase/witness.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::clash {
namespace {

using geometry::Part;

Relation mirrored(Relation r) {
  if (r == Relation::a_in_b) return Relation::b_in_a;
  if (r == Relation::b_in_a) return Relation::a_in_b;
  return r;
}

}  // namespace

bool in_canonical_order(const geometry::PartWithBvh& a, const geometry::PartWithBvh& b) {
  const Part &x = *a.placed.part, &y = *b.placed.part;
  if (&x != &y) {
    if (x.kind != y.kind) return x.kind < y.kind;
    if (x.triangles.size() != y.triangles.size()) return x.triangles.size() > y.triangles.size();
    if (x.vertices != y.vertices) return x.vertices < y.vertices;
    if (x.triangles != y.triangles) return x.triangles < y.triangles;
  }
  return a.placed.origin <= b.placed.origin;
}

geometry::Vec3d on_witness_grid(const geometry::Vec3d& p) { return geometry::in_steps(p, 65536); }

void round_to_witness_grid(PartPairResult& answer) {
  answer.witness.on_a = on_witness_grid(answer.witness.on_a);
  answer.witness.on_b = on_witness_grid(answer.witness.on_b);
}

void round_to_witness_grid(PairEvaluation& evaluation) { round_to_witness_grid(evaluation.answer); }

void swap_sides(PartPairResult& answer, const PairOperand& a, const PairOperand& b) {
  answer.relation = mirrored(answer.relation);
  answer.witness =
      mirrored(answer.witness, (b.treed.placed.origin - a.treed.placed.origin).as<double>());
}

void swap_sides(PairEvaluation& evaluation, const PairOperand& a, const PairOperand& b) {
  swap_sides(evaluation.answer, a, b);
}

}  // namespace strake::clash
