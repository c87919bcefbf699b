// SPDX-License-Identifier: Apache-2.0
#include <cstdint>

#include "geometry/basic/winding.hpp"
#include "geometry/pair_view.hpp"
#include "geometry/tree_walk.hpp"
#include "strake/geometry/part_pair.hpp"

namespace strake::geometry {
namespace {

/// The axis direction with the shortest way from a point out of a box.
Winding shortest_ray(const Box3i& box, const ScaledPoint& p) {
  Winding best;
  std::int64_t shortest = INT64_MAX;
  for (int k = 0; k < 3; ++k) {
    const std::int64_t up = box.hi[k] * p.denominator - p.numerator[k];
    const std::int64_t down = p.numerator[k] - box.lo[k] * p.denominator;
    if (up < shortest) {
      shortest = up;
      best = Winding(p, k, true);
    }
    if (down < shortest) {
      shortest = down;
      best = Winding(p, k, false);
    }
  }
  return best;
}

/// Counts what of a part a ray passes through, looking at every triangle where there is no tree;
/// false where the point is on the skin.
bool pass_all(const PartView& view, Winding& ray, PairWork& work) {
  const auto pass = [&](std::uint32_t triangle) { return ray.pass(view.corners(triangle)); };
  if (!view.planted()) {
    const auto n = static_cast<std::uint32_t>(view.part().triangles.size());
    std::uint32_t t = 0;
    while (t < n && pass(t)) ++t;
    return t == n;
  }
  const auto meets = [&](const PartTree::Node& node) {
    const bool met = ray.may_meet(node.box.lo, node.box.hi);
    if (met) ++work.node_pairs;
    return met;
  };
  return walk_tree(view.tree(), meets, pass);
}

const Box3i& box_of_all(const PartView& view) {
  return view.planted() ? view.tree().nodes().front().box : view.part().box;
}

PointSide probe(const TreedPart& part, const ScaledPoint& p, PairWork& work) {
  const PartView view(part, {});
  Winding ray = shortest_ray(box_of_all(view), p);
  if (!pass_all(view, ray, work)) return PointSide::on_boundary;
  return view.solid() && ray.number() >= 1 ? PointSide::inside : PointSide::outside;
}

}  // namespace

PointSide side_of(const TreedPart& part, const Vec3l& numerator, std::int64_t denominator,
                  PairWork& work) {
  const Box3i& box = box_of_all({part, {}});
  for (int k = 0; k < 3; ++k)
    if (numerator[k] < box.lo[k] * denominator || numerator[k] > box.hi[k] * denominator)
      return PointSide::outside;
  return probe(part, {numerator, denominator}, work);
}

}  // namespace strake::geometry
