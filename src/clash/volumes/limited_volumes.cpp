// SPDX-License-Identifier: Apache-2.0
#include "clash/volumes/limited_volumes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>

#include "clash/broad_phase/broad_phase.hpp"
#include "clash/volumes/common_volumes.hpp"
#include "geometry/intersection_volume/intersection_volume.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "strake/geometry/part.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::clash {
namespace {

using geometry::Box3d;
using geometry::Part;
using geometry::PartKind;
using geometry::Vec3d;

/// A convex polygon; cutting a triangle at the six planes of a box leaves nine corners at most.
struct Polygon {
  std::array<Vec3d, 16> corners;
  std::size_t count = 0;

  void add(const Vec3d& corner) { corners[count++] = corner; }
};

/// Returns the part of a polygon in which sign * coordinate k is at most sign * limit.
Polygon cut(const Polygon& polygon, int k, double limit, double sign) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Vec3d &p = polygon.corners[i], &q = polygon.corners[(i + 1) % polygon.count];
    const double at_p = sign * (p[k] - limit), at_q = sign * (q[k] - limit);
    if (at_p <= 0) kept.add(p);
    if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0))
      kept.add(p + (q - p) * (at_p / (at_p - at_q)));
  }
  return kept;
}

/// Returns the volume within `off` of a convex polygon: a slab, half cylinders along its edges and
/// a ball in all at its corners.
double volume_within(double off, const Polygon& polygon) {
  Vec3d twice_area;
  double around = 0;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Vec3d &p = polygon.corners[i], &q = polygon.corners[(i + 1) % polygon.count];
    twice_area = twice_area + cross(p - polygon.corners.front(), q - polygon.corners.front());
    around += length(q - p);
  }
  return off * length(twice_area) + std::numbers::pi / 2 * off * off * around +
         4 * std::numbers::pi / 3 * off * off * off;
}

/// Returns the volume within `off` of a part's triangles, as far as these lie in a box relative to
/// its origin.
double skin_volume(const Part& part, double off, const Box3d& box) {
  double volume = 0;
  if (!(off > 0)) return volume;
  for (const geometry::Triangle& triangle : part.triangles) {
    Polygon polygon;
    for (const std::uint32_t v : triangle) polygon.add(part.vertices[v].as<double>());
    for (int k = 0; k < 3 && polygon.count > 0; ++k)
      polygon = cut(cut(polygon, k, box.lo[k], -1), k, box.hi[k], 1);
    if (polygon.count > 0) volume += volume_within(off, polygon);
  }
  return volume;
}

/// Returns how far a part's true surface may lie from its triangles.
double off_by(const ScenePart& part) {
  return part.placed.part->sag + static_cast<double>(part.snap) + static_cast<double>(part.step);
}

/// Returns the box of `other`, so much larger, relative to the origin of `part`.
Box3d box_beside(const ScenePart& part, const ScenePart& other, double margin) {
  const Vec3d shift = (other.placed.origin - part.placed.origin).as<double>();
  const auto& box = other.placed.part->box;
  const Vec3d around{margin, margin, margin};
  return {box.lo.as<double>() + shift - around, box.hi.as<double>() + shift + around};
}

/// Returns by how much the volume that two solids have in common may differ from that of their
/// triangles, since tessellation, welds and the snap leave their surfaces where they are to within
/// a bound: no more than the volume within that bound of either surface near the other body. Cubic
/// grid units; 0 where the triangles are exact.
double volume_uncertainty(const ScenePart& a, const ScenePart& b) {
  const double off_a = off_by(a), off_b = off_by(b), margin = off_a + off_b;
  return skin_volume(*a.placed.part, off_a, box_beside(a, b, margin)) +
         skin_volume(*b.placed.part, off_b, box_beside(b, a, margin));
}

constexpr std::size_t kNoPair = std::numeric_limits<std::size_t>::max();

/// The results about two objects whose common volume is wanted: [first, end).
struct ObjectPairRun {
  std::size_t first = 0, end = 0;
};

bool needs_volume(const PartResults& results, const ObjectPairRun& run,
                  const Reporting& reporting) {
  const std::uint32_t a = results.a(run.first).object, b = results.b(run.first).object;
  if (results.rules.limits_volume(a, b)) return true;
  const auto of_run = std::span(results.found).subspan(run.first, run.end - run.first);
  return reporting.min_volume_mm3 > 0 && std::ranges::any_of(of_run, [](const PartResult& result) {
           return result.answer->classification.severest == Class::hit;
         });
}

std::vector<ObjectPairRun> runs_with_volume(const PartResults& results,
                                            const Reporting& reporting) {
  std::vector<ObjectPairRun> runs;
  if (!results.rules.limits_volumes() && !(reporting.min_volume_mm3 > 0)) return runs;
  for (ObjectPairRun run; run.first < results.found.size(); run.first = run.end) {
    run.end = run.first + 1;
    while (run.end < results.found.size() && results.same_objects(run.first, run.end)) ++run.end;
    if (needs_volume(results, run, reporting)) runs.push_back(run);
  }
  return runs;
}

/// Lists the solids of some pairs of objects that overlap, and notes where a sheet has a share in
/// it, of which there is no volume.
std::vector<SolidOverlap> overlaps_of(const PartResults& results,
                                      const std::vector<ObjectPairRun>& runs,
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
  const std::vector<ObjectPairRun> runs = runs_with_volume(results, report.options.reporting);
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
