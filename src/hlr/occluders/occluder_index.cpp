// SPDX-License-Identifier: Apache-2.0
#include "hlr/occluders/occluder_index.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include "hlr/edges/element_loop.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/slots.hpp"

namespace strake::hlr {
namespace {

// An index pays from this many polygons on. The faces of convex parts are seldom tested: their
// outline is. Half and twice of either are within 0.2 % in instructions of an isometric view of
// 3,000 objects, with and without imported detail.
constexpr std::size_t kIndexFrom = 12, kIndexFromIfConvex = 64;
// The BucketGrid::crowding() from which on a tree is better: where faces crowd in few buckets, or
// are much longer than wide. A traversal examines fewer: it leaves a bucket where nothing nearer is
// left. A knob of 45,000 faces on a plate of 900 wide ones takes more than 25 s in buckets and 0.2
// in a tree, 24,000 strips 7.1 and 0.05 (decision 0029).
constexpr double kCrowded = 256;

EdgeLengths lengths_of(std::span<const ProjectedEdge> edges) {
  EdgeLengths lengths{.count = static_cast<double>(edges.size())};
  for (const ProjectedEdge& e : edges)
    lengths.sum += static_cast<double>(std::max(std::abs(e.b.u - e.a.u), std::abs(e.b.v - e.a.v)));
  return lengths;
}

/// A part runs askew where the box of its longest edge takes this share of its own box, and is
/// rotated where the new box is smaller by this factor: areas. With both, the isometric view of a
/// rack of 900 pipes takes 0.5 CPU s, and 6.5 without; that of a ship of 100,000 objects takes 3.1,
/// and 3.3 to 4.2 without (decision 0031).
constexpr double kAskew = 0.25, kMaxRotatedArea = 0.5;
/// Farther out a rotated point would be no whole number that a double holds.
constexpr std::int64_t kFarthestRotated = std::int64_t{1} << 44;

double area(const ViewBox& box) {
  return (static_cast<double>(box.hi.u) - static_cast<double>(box.lo.u)) *
         (static_cast<double>(box.hi.v) - static_cast<double>(box.lo.v));
}

/// Returns the rotation along the longest edge, if that runs askew.
PaperRotation rotation_along(std::span<const ProjectedEdge> edges, const ViewBox& box) {
  double longest = 0, du = 0, dv = 0;
  for (const ProjectedEdge& e : edges) {
    const double u = static_cast<double>(e.b.u - e.a.u), v = static_cast<double>(e.b.v - e.a.v);
    if (u * u + v * v <= longest) continue;
    longest = u * u + v * v;
    du = u;
    dv = v;
  }
  if (std::abs(du * dv) <= kAskew * area(box)) return {};
  const double scale =
      static_cast<double>(PaperRotation::kMax) / std::max(std::abs(du), std::abs(dv));
  return {std::llround(du * scale), std::llround(dv * scale)};
}

std::vector<ViewBox> rotated_boxes(const OccluderPolygons& all,
                                   std::span<const OccluderPolygon> polygons,
                                   const PaperRotation& rotation) {
  std::vector<ViewBox> boxes;
  boxes.reserve(polygons.size());
  for (const OccluderPolygon& p : polygons) {
    ViewBox box;
    for (const PaperCorner& c : std::span(all.corners).subspan(p.first_corner, p.corners))
      for (const std::int64_t w : {p.box.lo.w, p.box.hi.w}) box.include(rotation({c.u, c.v, w}));
    boxes.push_back(box);
  }
  return boxes;
}

/// Returns whether the part is indexed in axes of its own (decision 0031).
bool index_rotated(const OccluderPolygons& all, std::span<const OccluderPolygon> polygons,
                   std::span<const ProjectedEdge> edges, std::size_t from, OccluderPart& part) {
  const ViewPoint &lo = part.box.lo, &hi = part.box.hi;
  if (std::max({std::abs(lo.u), std::abs(lo.v), std::abs(hi.u), std::abs(hi.v)}) > kFarthestRotated)
    return false;
  const PaperRotation rotation = rotation_along(edges, part.box);
  if (rotation.is_none()) return false;
  const std::vector<ViewBox> boxes = rotated_boxes(all, polygons, rotation);
  ViewBox box;
  for (const ViewBox& one : boxes) box.include(one);
  const auto scale = static_cast<double>(rotation.c * rotation.c + rotation.s * rotation.s);
  if (area(box) > kMaxRotatedArea * scale * area(part.box)) return false;
  part.rotation = rotation;
  part.rotated_box = rounded_outwards(box);
  // Its facets are long strips along these axes, which buckets do not separate.
  if (polygons.size() >= from) part.tree = ViewBvh(boxes);
  return true;
}

Result<std::vector<ViewBox>> boxes_of(std::span<const OccluderPolygon> polygons,
                                      const ProjectionSettings& settings) {
  auto boxes = parallel::slots<ViewBox>(polygons.size(), settings.context);
  if (!boxes) return boxes;
  const Status status =
      parallel::for_each(settings.context, over_elements("hidden lines: boxes", boxes->size()),
                         [&](std::size_t i) { (*boxes)[i] = polygons[i].box; });
  if (!status) return status.error();
  return boxes;
}

Result<BucketPlan> plan_of(const std::vector<ViewBox>& boxes, const ProjectionSettings& settings) {
  return parallel::reduce(
      settings.context, over_elements("hidden lines: sizes of boxes", boxes.size()), BucketPlan(),
      [&](BucketPlan& plan, std::size_t i) { plan.add(boxes[i]); },
      [](BucketPlan& plan, const BucketPlan& more) { plan.add(more); });
}

Status choose(const std::vector<ViewBox>& boxes, std::span<const ProjectedEdge> edges,
              const ProjectionSettings& settings, OccluderPart& part) {
  if (settings.perspective_map == nullptr) {
    const Result<BucketPlan> plan = plan_of(boxes, settings);
    if (!plan) return plan.error();
    const std::uint32_t side = plan->best_side(lengths_of(edges));
    auto buckets = BucketGrid::of(boxes, plan->axes(side), settings.context);
    if (!buckets) return buckets.error();
    if (buckets->crowding() <= kCrowded) {
      part.buckets = std::move(*buckets);
      return {};
    }
  }
  part.tree = ViewBvh(boxes);
  return {};
}

}  // namespace

Status build_occluder_index(const OccluderPolygons& all, std::span<const ProjectedEdge> edges,
                            std::vector<PaperCorner> hubs, bool convex,
                            const ProjectionSettings& settings, OccluderPart& part) {
  const auto polygons = std::span(all.polygons).subspan(part.first, part.last - part.first);
  const bool by_data = settings.bucketing == Options::kBucketsByData;
  const std::size_t from = !by_data ? 2 : convex ? kIndexFromIfConvex : kIndexFrom;
  if (by_data && settings.perspective_map == nullptr && polygons.size() < kBigShape &&
      index_rotated(all, polygons, edges, from, part))
    return {};
  if (polygons.size() < from || settings.bucketing == Options::kNoBuckets) return {};
  auto boxes = boxes_of(polygons, settings);
  if (!boxes) return boxes.error();
  part.fans = extract_fans(std::move(hubs), polygons, all.corners, *boxes);
  if (std::ranges::all_of(*boxes, &ViewBox::empty)) return {};
  if (by_data) return choose(*boxes, edges, settings, part);
  const Result<BucketPlan> plan = plan_of(*boxes, settings);
  if (!plan) return plan.error();
  auto buckets = BucketGrid::of(*boxes, plan->axes(static_cast<std::uint32_t>(settings.bucketing)),
                                settings.context);
  if (!buckets) return buckets.error();
  part.buckets = std::move(*buckets);
  return {};
}

}  // namespace strake::hlr
