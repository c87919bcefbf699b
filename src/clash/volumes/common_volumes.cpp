// SPDX-License-Identifier: Apache-2.0
#include "clash/volumes/common_volumes.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "geometry/intersection_volume/intersection_volume.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/order.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::clash {
namespace {

using geometry::Part;
using geometry::PartKind;

/// The most that the volume of one pair may cost, in triangle pairs and tree nodes: some more than
/// it takes where each triangle lies over a few of the other part, as on surfaces of like fineness.
constexpr std::uint64_t kWorkPerTriangle = 16, kMinWork = 4096;

std::uint64_t max_work(const Part& a, const Part& b) {
  return kMinWork + kWorkPerTriangle * (a.triangles.size() + b.triangles.size());
}

std::vector<SolidOverlap> overlaps_of_hits(const PartResults& results,
                                           const std::vector<Pair>& pairs) {
  std::vector<SolidOverlap> overlaps;
  std::size_t pair = 0, last = std::numeric_limits<std::size_t>::max();
  for (std::size_t i = 0; i < results.found.size(); ++i) {
    const PartResult& f = results.found[i];
    if (!f.answer->separation.interiors_meet) continue;
    if (f.pair_index == last) continue;  // another region of the same parts
    last = f.pair_index;
    const ScenePart &a = results.a(i), &b = results.b(i);
    const auto before = [&](const Pair& p) {
      return index(p.a) != a.object ? index(p.a) < a.object : index(p.b) < b.object;
    };
    while (pair < pairs.size() && before(pairs[pair])) ++pair;
    if (pair == pairs.size()) break;
    if (index(pairs[pair].a) != a.object || index(pairs[pair].b) != b.object) continue;
    if (pairs[pair].cls != Class::hit) continue;
    if (a.placed.part->kind == PartKind::solid && b.placed.part->kind == PartKind::solid)
      overlaps.push_back({&a, &b, pair});
  }
  return overlaps;
}

/// Returns which unique parts overlap.
std::vector<bool> parts_of(const std::vector<SolidOverlap>& overlaps, std::size_t unique) {
  std::vector<bool> parts(unique, false);
  for (const SolidOverlap& o : overlaps) parts[o.a->unique] = parts[o.b->unique] = true;
  return parts;
}

}  // namespace

Result<std::vector<std::optional<geometry::IntersectionVolume>>> measure_overlaps(
    const std::vector<SolidOverlap>& overlaps, const ScenePartList& list, AccelerationCache& cache,
    const parallel::Context& context, Counters& counters) {
  const Status trees_made = cache.ensure_trees(parts_of(overlaps, list.unique.size()), context);
  if (!trees_made) return trees_made.error();
  const auto order = parallel::longest_first(overlaps.size(), [&](std::size_t i) {
    return max_work(*overlaps[i].a->placed.part, *overlaps[i].b->placed.part);
  });
  auto measured = parallel::transform(
      context, {.name = "common volumes", .n = overlaps.size(), .order = order},
      [&](std::size_t i) {
        const SolidOverlap& o = overlaps[i];
        return geometry::intersection_volume(cache.treed(*o.a).treed, cache.treed(*o.b).treed,
                                             max_work(*o.a->placed.part, *o.b->placed.part));
      });
  if (!measured) return measured.error();
  for (const auto& volume : *measured) {
    if (volume)
      counters.volume_triangle_pairs += volume->triangle_pairs;
    else
      ++counters.volumes_given_up;
  }
  return measured;
}

Status measure_volumes(const PartResults& results, AccelerationCache& cache,
                       const parallel::Context& context, Report& report) {
  const std::vector<SolidOverlap> overlaps = overlaps_of_hits(results, report.pairs);
  const auto measured = measure_overlaps(overlaps, results.list, cache, context, report.counters);
  if (!measured) return measured.error();
  std::vector<bool> unknown(report.pairs.size(), false);
  for (std::size_t i = 0; i < overlaps.size(); ++i) {
    const std::size_t p = overlaps[i].pair;
    const auto& common = (*measured)[i];
    if (common)
      report.pairs[p].volume_mm3 =
          report.pairs[p].volume_mm3.value_or(0) + common->volume / kCubicGridPerMm;
    else
      unknown[p] = true;
  }
  for (std::size_t p = 0; p < unknown.size(); ++p)
    if (unknown[p]) report.pairs[p].volume_mm3.reset();
  return {};
}

}  // namespace strake::clash
