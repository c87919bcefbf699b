// SPDX-License-Identifier: Apache-2.0
#include "clash/volumes/limited_volumes.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>

#include "clash/volumes/common_volumes.hpp"
#include "clash/volumes/volume_bracket.hpp"
#include "geometry/intersection_volume/intersection_volume.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::clash {
namespace {

using geometry::PartKind;

constexpr std::size_t kNoPair = std::numeric_limits<std::size_t>::max();

/// The results about two objects whose common volume is wanted: [first, end).
struct Run {
  std::size_t first = 0, end = 0;
};

bool is_wanted(const PartResults& results, const Run& run, const Reporting& reporting) {
  const std::uint32_t a = results.a(run.first).object, b = results.b(run.first).object;
  if (results.rules.limits_volume(a, b)) return true;
  const auto of_run = std::span(results.found).subspan(run.first, run.end - run.first);
  return reporting.min_volume_mm3 > 0 && std::ranges::any_of(of_run, [](const PartResult& result) {
           return result.answer->classification.severest == Class::hit;
         });
}

std::vector<Run> wanted_runs(const PartResults& results, const Reporting& reporting) {
  std::vector<Run> runs;
  if (!results.rules.limits_volumes() && !(reporting.min_volume_mm3 > 0)) return runs;
  for (Run run; run.first < results.found.size(); run.first = run.end) {
    run.end = run.first + 1;
    while (run.end < results.found.size() && results.same_objects(run.first, run.end)) ++run.end;
    if (is_wanted(results, run, reporting)) runs.push_back(run);
  }
  return runs;
}

/// Lists the solids of some pairs of objects that overlap, and notes where a sheet has a share in
/// it, of which there is no volume.
std::vector<SolidOverlap> overlaps_of(const PartResults& results, const std::vector<Run>& runs,
                                      std::vector<CommonVolume>& volumes) {
  std::vector<SolidOverlap> overlaps;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    std::size_t last = kNoPair;
    for (std::size_t i = runs[r].first; i < runs[r].end; ++i) {
      const PartResult& result = results.found[i];
      if (!result.answer->separation.interiors_meet || result.pair_index == last) continue;
      last = result.pair_index;  // the others are further regions of the same parts
      const ScenePart &a = results.a(i), &b = results.b(i);
      if (a.placed.part->kind == PartKind::solid && b.placed.part->kind == PartKind::solid)
        overlaps.push_back({&a, &b, r});
      else
        volumes[r].add_unknown();
    }
  }
  return overlaps;
}

}  // namespace

Status measure_limited_volumes(const PartResults& results, std::vector<PartResult>& found,
                               std::vector<CommonVolume>& volumes, AccelerationCache& cache,
                               const parallel::Context& context, Report& report) {
  const std::vector<Run> runs = wanted_runs(results, report.options.reporting);
  volumes.assign(runs.size(), {});
  if (runs.empty()) return {};
  const std::vector<SolidOverlap> overlaps = overlaps_of(results, runs, volumes);
  const auto measured = measure_overlaps(overlaps, results.list, cache, context, report.counters);
  if (!measured) return measured.error();
  const auto off = parallel::transform(
      context, {.name = "brackets of volumes", .n = overlaps.size()},
      [&](std::size_t i) { return volume_uncertainty(*overlaps[i].a, *overlaps[i].b); });
  if (!off) return off.error();
  for (std::size_t i = 0; i < overlaps.size(); ++i) {
    CommonVolume& volume = volumes[overlaps[i].pair];
    if (const auto& common = (*measured)[i]) {
      volume.lower += std::max(0.0, common->lower - (*off)[i]) / kCubicGridPerMm;
      volume.upper += (common->upper + (*off)[i]) / kCubicGridPerMm;
    } else {
      volume.add_unknown();
    }
  }
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (std::size_t i = runs[r].first; i < runs[r].end; ++i) found[i].common = &volumes[r];
  return {};
}

}  // namespace strake::clash
