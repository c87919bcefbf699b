// SPDX-License-Identifier: Apache-2.0
#include "hlr/part_index.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include "hlr/by_size.hpp"
#include "strake/parallel/slots.hpp"

namespace strake::hlr {
namespace {

// An index pays from this many polygons on. The faces of convex parts are seldom asked: their
// outline is.
constexpr std::size_t kIndexFrom = 12, kIndexFromIfConvex = 64;
// Buckets::crowding() from which on a tree is better: where faces crowd in few buckets, or are much
// longer than wide. Less is looked at than that: a walk leaves a bucket where nothing nearer is
// left.
constexpr double kCrowded = 256;

EdgeLengths lengths_of(std::span<const EdgeView> edges) {
  EdgeLengths lengths{.count = static_cast<double>(edges.size())};
  for (const EdgeView& e : edges)
    lengths.sum += static_cast<double>(std::max(std::abs(e.b.u - e.a.u), std::abs(e.b.v - e.a.v)));
  return lengths;
}

Result<std::vector<ViewBox>> boxes_of(std::span<const Polygon> polygons, const Sight& sight) {
  auto boxes = parallel::slots<ViewBox>(polygons.size(), sight.context);
  if (!boxes) return boxes;
  const Status status = for_elements(sight.context, "hidden lines: boxes", boxes->size(),
                                     [&](std::size_t i) { (*boxes)[i] = polygons[i].box; });
  if (!status) return status.error();
  return boxes;
}

Result<BucketPlan> plan_of(const std::vector<ViewBox>& boxes, const Sight& sight) {
  return fold_elements(
      sight.context, "hidden lines: sizes of boxes", boxes.size(), BucketPlan(),
      [&](BucketPlan& plan, std::size_t i) { plan.add(boxes[i]); },
      [](BucketPlan& plan, const BucketPlan& more) { plan.add(more); });
}

Status choose(const std::vector<ViewBox>& boxes, std::span<const EdgeView> edges,
              const Sight& sight, PartView& part) {
  if (sight.picture == nullptr) {
    const Result<BucketPlan> plan = plan_of(boxes, sight);
    if (!plan) return plan.error();
    const std::uint32_t side = plan->best_side(lengths_of(edges));
    auto buckets = Buckets::of(boxes, plan->axes(side), sight.context);
    if (!buckets) return buckets.error();
    if (buckets->crowding() <= kCrowded) {
      part.buckets = std::move(*buckets);
      return {};
    }
  }
  part.tree = ViewTree(boxes);
  return {};
}

}  // namespace

Status index(std::span<const Polygon> polygons, std::span<const EdgeView> edges, bool convex,
             const Sight& sight, PartView& part) {
  const bool by_data = sight.bucketing == Options::kBucketsByData;
  const std::size_t from = !by_data ? 2 : convex ? kIndexFromIfConvex : kIndexFrom;
  if (polygons.size() < from || sight.bucketing == Options::kNoBuckets) return {};
  const auto boxes = boxes_of(polygons, sight);
  if (!boxes) return boxes.error();
  if (by_data) return choose(*boxes, edges, sight, part);
  const Result<BucketPlan> plan = plan_of(*boxes, sight);
  if (!plan) return plan.error();
  auto buckets =
      Buckets::of(*boxes, plan->axes(static_cast<std::uint32_t>(sight.bucketing)), sight.context);
  if (!buckets) return buckets.error();
  part.buckets = std::move(*buckets);
  return {};
}

}  // namespace strake::hlr
