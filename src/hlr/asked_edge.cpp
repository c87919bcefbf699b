// SPDX-License-Identifier: Apache-2.0
#include "hlr/asked_edge.hpp"

#include <algorithm>

namespace strake::hlr {

using geometry::Int128;
using geometry::Vec3l;

namespace {

/// Cuts [lo, hi] down to where an affine function, known at 0 and 1, is not negative.
bool clip_affine(Int128 at_a, Int128 at_b, Param& lo, Param& hi) {
  if (at_a >= 0 && at_b >= 0) return true;
  if (at_a <= 0 && at_b <= 0) return false;
  if (at_a < at_b) {
    const Param root = Param::of(-at_a, at_b - at_a);
    if (less(lo, root)) lo = root;
  } else {
    const Param root = Param::of(at_a, at_a - at_b);
    if (less(root, hi)) hi = root;
  }
  return less(lo, hi);
}

}  // namespace

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
      va(world.picture ? ViewPoint{} : world.frame(a)),
      vb(world.picture ? ViewPoint{} : world.frame(b)) {
  projecting = world.job.viewer.sees_as_point(a, b);
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
    if (!clip_affine(a[k] - limits.lo[k], b[k] - limits.lo[k], lo, hi) ||
        !clip_affine(limits.hi[k] - a[k], limits.hi[k] - b[k], lo, hi))
      return false;
  return true;
}

bool AskedEdge::clip(std::span<const HalfSpace> window, Param& lo, Param& hi) const {
  for (const HalfSpace& half : window) {
    const NormalVector n{half.normal.x, half.normal.y, half.normal.z};
    if (!clip_affine(along(n, a) - half.least, along(n, b) - half.least, lo, hi)) return false;
  }
  return true;
}

}  // namespace strake::hlr
