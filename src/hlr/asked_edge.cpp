// SPDX-License-Identifier: Apache-2.0
#include "hlr/asked_edge.hpp"

#include <algorithm>

namespace strake::hlr {

using geometry::Vec3l;

AskedEdge::AskedEdge(const World& world, std::uint32_t body_index, const EdgeView& e)
    : body(body_index),
      own(&world.placed[body_index]),
      other(own),
      feature(&e),
      kind(e.edge.kind),
      projecting(e.edge.projecting),
      cut_away(e.edge.cut_away),
      contact(own->contact),
      a(e.edge.a.as<std::int64_t>() + own->offset),
      b(e.edge.b.as<std::int64_t>() + own->offset),
      va(e.a + own->at),
      vb(e.b + own->at) {}

AskedEdge::AskedEdge(const World& world, const Line& line)
    : body(line.body_a),
      own(&world.placed[line.body_a]),
      other(&world.placed[line.body_b]),
      kind(line.kind),
      cut_away(line.cut_away),
      contact(std::max({own->contact, other->contact, world.job.lines.contact})),
      a(line.a - world.job.origin),
      b(line.b - world.job.origin),
      va(world.frame(a)),
      vb(world.frame(b)) {
  projecting = geometry::cross(b - a, world.job.direction()) == Vec3l{};
}

Vec3l AskedEdge::at(const Param& t, const Vec3l& origin) const {
  if (t.num == 0) return a + origin;
  if (t.num == t.den) return b + origin;
  Vec3l p = a + origin;
  for (int k = 0; k < 3; ++k)
    if (a[k] != b[k]) p[k] += rounded_share(b[k] - a[k], t);
  return p;
}

bool AskedEdge::clip(const geometry::Box3l& limits, Param& lo, Param& hi) const {
  for (int k = 0; k < 3; ++k)
    for (const int sign : {1, -1}) {
      const std::int64_t limit = sign > 0 ? limits.lo[k] : limits.hi[k];
      const std::int64_t at_a = sign * (a[k] - limit), at_b = sign * (b[k] - limit);
      if (at_a >= 0 && at_b >= 0) continue;
      if (at_a <= 0 && at_b <= 0) return false;
      if (at_a < at_b) {
        const Param root = Param::of(-at_a, at_b - at_a);
        if (less(lo, root)) lo = root;
      } else {
        const Param root = Param::of(at_a, at_a - at_b);
        if (less(root, hi)) hi = root;
      }
      if (!less(lo, hi)) return false;
    }
  return true;
}

}  // namespace strake::hlr
