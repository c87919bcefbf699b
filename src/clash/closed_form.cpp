// SPDX-License-Identifier: Apache-2.0
#include "clash/closed_form.hpp"

#include <algorithm>
#include <cmath>

#include "strake/geometry/grid.hpp"

namespace strake::clash {

using geometry::Part;
using geometry::PartKind;

std::optional<ClosedForm> closed_form(const NarrowPart& a, const NarrowPart& b, double enough) {
  const Part &x = *a.treed.placed.part, &y = *b.treed.placed.part;
  const auto &p = x.primitive, &q = y.primitive;
  if (!p || !q || a.placement == nullptr || b.placement == nullptr) return std::nullopt;
  // Triangles that are the true surface are compared exactly.
  if (!(x.sag + y.sag > 0)) return std::nullopt;
  const auto s = geometry::analytic_separation({&*p, a.placement}, {&*q, b.placement}, enough + 1);
  const auto centre = geometry::snap(a.placement->translation);
  if (!s || !centre) return std::nullopt;
  if (s->sheet_a != (x.kind == PartKind::sheet) || s->sheet_b != (y.kind == PartKind::sheet))
    return std::nullopt;
  return ClosedForm{*s, s->point + (*centre - a.treed.placed.origin).as<double>(),
                    !(s->lower > 1 || s->upper < -1)};
}

Relation relation_of(const geometry::AnalyticSeparation& s, double band) {
  const bool sheet = s.sheet_a || s.sheet_b;
  if (s.difference <= band) return Relation::duplicate;
  if (std::fabs(s.d) <= band) return Relation::abut_outside;
  if (s.d > 0) return Relation::separate;
  if (s.a_inside_b > band) return Relation::a_in_b;
  if (s.b_inside_a > band) return Relation::b_in_a;
  if (sheet) return Relation::cross;
  return std::max(s.a_inside_b, s.b_inside_a) >= -band ? Relation::abut_inside
                                                       : Relation::interfere;
}

}  // namespace strake::clash
