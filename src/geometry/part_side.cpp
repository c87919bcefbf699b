// SPDX-License-Identifier: Apache-2.0
#include "geometry/part_side.hpp"

#include <cstdint>

#include "geometry/basic/winding.hpp"
#include "geometry/boxed_tree.hpp"
#include "geometry/pair_view.hpp"
#include "geometry/segment_box.hpp"
#include "geometry/tree_walk.hpp"

namespace strake::geometry {
namespace {

/// The axis direction with the shortest way from a point out of a box.
struct Ray {
  int axis = 0;
  bool upward = true;
  std::int64_t length = INT64_MAX;  ///< as the point's numerators
};

Ray shortest_ray(const Box3i& box, const ScaledPoint& p) {
  Ray best;
  for (int k = 0; k < 3; ++k) {
    const std::int64_t up = box.hi[k] * p.denominator - p.numerator[k];
    const std::int64_t down = p.numerator[k] - box.lo[k] * p.denominator;
    if (up < best.length) best = {k, true, up};
    if (down < best.length) best = {k, false, down};
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

/// The same by the boxes of a turned frame, as far as the ray goes.
bool pass_in_frame(const PartView& view, const TurnedFrame& frame, const Ray& way,
                   const ScaledPoint& p, Winding& ray, PairWork& work) {
  const double scale = 1 / static_cast<double>(p.denominator);
  Vec3d along;
  along[way.axis] = static_cast<double>(way.length) * scale * (way.upward ? 1 : -1);
  const Vec3d from = turned(frame.axes, p.numerator.as<double>() * scale);
  const Vec3d to = from + turned(frame.axes, along);
  const BoxedTree boxes(frame.part);
  const auto meets = [&](const Box3d& box) {
    return may_meet(from, to, box.inflated(kFrameRounding));
  };
  return walk_tree(
      boxes.tree(),
      [&](const PartTree::Node& node) {
        const bool met = meets(boxes.box(node));
        if (met) ++work.node_pairs;
        return met;
      },
      [&](std::uint32_t t) { return !meets(boxes.turned_box(t)) || ray.pass(view.corners(t)); });
}

const Box3i& box_of_all(const PartView& view) {
  return view.planted() ? view.tree().nodes().front().box : view.part().box;
}

}  // namespace

PointSide side_of(const TreedPart& part, const Vec3l& numerator, std::int64_t denominator,
                  PairWork& work, const TurnedFrame* frame) {
  const PartView view(part, {});
  const Box3i& box = box_of_all(view);
  for (int k = 0; k < 3; ++k)
    if (numerator[k] < box.lo[k] * denominator || numerator[k] > box.hi[k] * denominator)
      return PointSide::outside;
  const ScaledPoint p{numerator, denominator};
  const Ray way = shortest_ray(box, p);
  Winding ray(p, way.axis, way.upward);
  const bool beside =
      frame == nullptr ? pass_all(view, ray, work) : pass_in_frame(view, *frame, way, p, ray, work);
  if (!beside) return PointSide::on_boundary;
  return view.solid() && ray.number() >= 1 ? PointSide::inside : PointSide::outside;
}

PointSide side_of(const TreedPart& part, const Vec3l& numerator, std::int64_t denominator,
                  PairWork& work) {
  return side_of(part, numerator, denominator, work, nullptr);
}

}  // namespace strake::geometry
