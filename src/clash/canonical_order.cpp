// SPDX-License-Identifier: Apache-2.0
#include "clash/canonical_order.hpp"

#include "clash/witness.hpp"
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

bool in_canonical_order(const geometry::TreedPart& a, const geometry::TreedPart& b) {
  const Part &x = *a.placed.part, &y = *b.placed.part;
  if (&x != &y) {
    if (x.kind != y.kind) return x.kind < y.kind;
    if (x.triangles.size() != y.triangles.size()) return x.triangles.size() > y.triangles.size();
    if (x.vertices != y.vertices) return x.vertices < y.vertices;
    if (x.triangles != y.triangles) return x.triangles < y.triangles;
  }
  return a.placed.origin <= b.placed.origin;
}

geometry::Vec3d in_witness_steps(const geometry::Vec3d& p) { return geometry::in_steps(p, 65536); }

void put_in_steps(PartAnswer& answer) {
  answer.witness.on_a = in_witness_steps(answer.witness.on_a);
  answer.witness.on_b = in_witness_steps(answer.witness.on_b);
}

void put_in_steps(FirstLook& look) { put_in_steps(look.answer); }

void turn(PartAnswer& answer, const NarrowPart& a, const NarrowPart& b) {
  answer.relation = mirrored(answer.relation);
  answer.witness =
      mirrored(answer.witness, (b.treed.placed.origin - a.treed.placed.origin).as<double>());
}

void turn(FirstLook& look, const NarrowPart& a, const NarrowPart& b) { turn(look.answer, a, b); }

}  // namespace strake::clash
