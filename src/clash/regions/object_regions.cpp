// SPDX-License-Identifier: Apache-2.0
#include "clash/regions/object_regions.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>

#include "core/union_find.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/slots.hpp"

namespace strake::clash {
namespace {

using geometry::Box3d;

/// A region of one pair of parts.
struct LocatedResult {
  Pair result;
  Box3d box_mm;
  std::size_t pair_index = 0;
};

struct Regions {
  std::uint32_t count = 0;
  std::vector<Region> worst = {};    ///< the regions, if there are several
  std::vector<Region> allowed = {};  ///< for a pair that no rule allows: all that a rule does
};

/// The regions of a pair that does not have just one, or has allowed ones besides.
struct RegionList {
  std::size_t pair = 0;
  Regions regions;
};

Region region_of(const LocatedResult& located) {
  const Pair& p = located.result;
  return {.cls = p.cls,
          .flags = p.flags,
          .d_mm = p.d_mm,
          .d_lower_mm = p.d_lower_mm,
          .d_upper_mm = p.d_upper_mm,
          .point_mm = p.point_mm,
          .box_mm = located.box_mm,
          .part_a = p.part_a,
          .part_b = p.part_b,
          .allowed = p.allowed,
          .depth_complete = p.depth_complete};
}

/// Whether a region counts for a pair of objects with this result.
bool counts(const Pair& located, const Pair& whole) {
  if ((located.allowed < 0) != (whole.allowed < 0)) return false;
  if (whole.cls == Class::clearance_violation) return located.cls == whole.cls;
  return located.cls >= Class::contact;
}

/// Whether x is worse than y. Of regions that are equally bad, that of the pair's own witness is
/// the worst.
bool worse(const LocatedResult& x, const LocatedResult& y, const Pair& whole) {
  const auto is_witness = [&](const Pair& p) {
    return p.part_a == whole.part_a && p.part_b == whole.part_b && p.d_mm == whole.d_mm &&
           p.point_mm == whole.point_mm;
  };
  if (is_witness(x.result) != is_witness(y.result)) return is_witness(x.result);
  return is_more_severe(x.result, y.result);
}

/// Joins regions of different pairs of parts whose boxes meet, in one sweep along x.
UnionFind joined(const std::vector<LocatedResult>& located_results) {
  UnionFind sets(located_results.size());
  const auto of_first = [&](const LocatedResult& p) {
    return p.pair_index == located_results.front().pair_index;
  };
  if (std::ranges::all_of(located_results, of_first)) return sets;
  std::vector<std::uint32_t> order(located_results.size()), open;
  std::iota(order.begin(), order.end(), std::uint32_t{0});
  std::ranges::sort(order, [&](std::uint32_t i, std::uint32_t j) {
    return std::pair(located_results[i].box_mm.lo.x, i) <
           std::pair(located_results[j].box_mm.lo.x, j);
  });
  for (const std::uint32_t i : order) {
    const LocatedResult& located = located_results[i];
    std::erase_if(open, [&](std::uint32_t j) {
      return located_results[j].box_mm.hi.x < located.box_mm.lo.x;
    });
    for (const std::uint32_t j : open)
      if (located_results[j].pair_index != located.pair_index &&
          located_results[j].box_mm.meets(located.box_mm))
        sets.join(i, j);
    open.push_back(i);
  }
  return sets;
}

class RegionsOfPairs {
 public:
  explicit RegionsOfPairs(const PartResults& results, std::uint64_t limit)
      : results_(results), limit_(limit) {}

  [[nodiscard]] Regions of(const Pair& pair) const {
    const std::size_t first = pair.first_region;
    if (!results_.has_more(first))
      return {.count = results_.found[first].region_count_uncertain ? 0U : 1U};
    std::vector<LocatedResult> located_results, allowed;
    bool region_count_uncertain = false;
    for (std::size_t i = first; i < results_.found.size() && results_.same_objects(first, i); ++i) {
      LocatedResult located = located_result(i);
      if (pair.allowed < 0 && located.result.allowed >= 0) {
        allowed.push_back(std::move(located));
      } else if (counts(located.result, pair)) {
        region_count_uncertain = region_count_uncertain || results_.found[i].region_count_uncertain;
        located_results.push_back(std::move(located));
      }
    }
    Regions regions{.count = region_count_uncertain ? 0U : 1U};
    if (!region_count_uncertain && located_results.size() > 1)
      take(together(located_results, pair), regions);
    if (!allowed.empty()) regions.allowed = allowed_of(std::move(allowed), pair);
    return regions;
  }

 private:
  [[nodiscard]] LocatedResult located_result(std::size_t i) const {
    LocatedResult located{results_.pair(i), {}, results_.found[i].pair_index};
    const double apart = std::max(located.result.d_upper_mm, 0.0) * geometry::kGridPerMm;
    located.box_mm = results_.extent_mm(i).value_or(
        common_box_mm(results_.a(i), results_.b(i), search_margin(apart)));
    return located;
  }

  /// Returns one region of each set, the worst first.
  [[nodiscard]] static std::vector<LocatedResult> together(
      const std::vector<LocatedResult>& located_results, const Pair& whole) {
    UnionFind sets = joined(located_results);
    std::vector<LocatedResult> worst;
    std::vector<std::size_t> number(located_results.size());
    for (std::uint32_t i = 0; i < located_results.size(); ++i) {
      const std::uint32_t root = sets.root(i);
      if (root == i) {
        number[i] = worst.size();
        worst.push_back(located_results[i]);
        continue;
      }
      LocatedResult& known = worst[number[root]];
      Box3d box = known.box_mm;
      box.include(located_results[i].box_mm);
      if (worse(located_results[i], known, whole)) known = located_results[i];
      known.box_mm = box;
    }
    std::ranges::sort(
        worst, [&](const LocatedResult& x, const LocatedResult& y) { return worse(x, y, whole); });
    return worst;
  }

  void take(const std::vector<LocatedResult>& worst, Regions& regions) const {
    regions.count = static_cast<std::uint32_t>(worst.size());
    if (regions.count < 2) return;
    const std::uint64_t listed = std::min<std::uint64_t>(worst.size(), limit_);
    for (std::size_t i = 0; i < listed; ++i) regions.worst.push_back(region_of(worst[i]));
  }

  /// Returns what a rule allows of a pair that none allows as a whole. Gaps round a hit or a
  /// contact, be it allowed, do not count, as they do not where nothing is allowed. Where there are
  /// too many triangles to distinguish regions, one stands for all.
  [[nodiscard]] static std::vector<Region> allowed_of(std::vector<LocatedResult> located_results,
                                                      const Pair& whole) {
    Class worst = whole.cls;
    for (const LocatedResult& located : located_results)
      worst = std::max(worst, located.result.cls);
    const Class least = std::min(worst, Class::contact);
    std::erase_if(located_results,
                  [&](const LocatedResult& located) { return located.result.cls < least; });
    std::vector<Region> regions;
    for (const LocatedResult& located : together(located_results, whole))
      regions.push_back(region_of(located));
    return regions;
  }

  const PartResults& results_;
  std::uint64_t limit_;
};

/// Appends how many regions of a pair each rule allows, by rule.
void keep_counts(const Pair& pair, const std::vector<Region>& allowed,
                 std::vector<AllowedRegionCount>& kept) {
  std::map<std::uint32_t, std::uint32_t> by_rule;
  for (const Region& region : allowed) ++by_rule[static_cast<std::uint32_t>(region.allowed)];
  for (const auto& [rule, regions] : by_rule) kept.push_back({pair.a, pair.b, rule, regions});
}

}  // namespace

Status aggregate_regions(const PartResults& results, const parallel::Context& context,
                         Report& report) {
  // Only shares the work out: between 64 and 1024 no difference can be seen (decision 0073).
  constexpr std::size_t kGrain = 256;
  const bool found_regions = report.options.engine.max_regions > 0;
  const RegionsOfPairs regions(results, report.options.engine.max_regions);
  auto others = parallel::collect<RegionList>(
      context, {.name = "regions", .n = report.pairs.size(), .grain = kGrain},
      [&](std::size_t i, std::vector<RegionList>& out) {
        Pair& pair = report.pairs[i];
        Regions of = regions.of(pair);
        pair.regions = found_regions ? of.count : 0;
        pair.first_region = 0;
        pair.allowed_regions = static_cast<std::uint32_t>(of.allowed.size());
        if (of.count != 1 || !of.allowed.empty()) out.push_back({i, std::move(of)});
      });
  if (!others) return others.error();
  // Where the regions of each pair begin is known before they are written, by all workers.
  std::size_t regions_listed = 0;
  for (const RegionList& other : *others) {
    const auto& [count, worst, allowed] = other.regions;
    Pair& pair = report.pairs[other.pair];
    const std::size_t listed = worst.size() + pair.allowed_regions_listed(report.options);
    if (listed > 0) pair.first_region = static_cast<std::uint32_t>(regions_listed);
    regions_listed += listed;
    for (const Region& region : allowed)
      ++report.allowed[static_cast<std::size_t>(region.allowed)].regions;
    if (report.kept) keep_counts(pair, allowed, report.kept->allowed_regions);
    report.count_allowed_regions += allowed.size();
    if (found_regions && count == 0) ++report.counters.regions_given_up;
  }
  auto listed = parallel::slots<Region>(regions_listed, context);
  if (!listed) return listed.error();
  report.regions = std::move(*listed);
  return parallel::for_each(
      context, {.name = "regions listed", .n = others->size(), .grain = kGrain},
      [&](std::size_t i) {
        // The worker that takes them also gives their memory back.
        const Regions of = std::move((*others)[i].regions);
        const Pair& pair = report.pairs[(*others)[i].pair];
        auto out = report.regions.begin() + static_cast<std::ptrdiff_t>(pair.first_region);
        out = std::ranges::copy(of.worst, out).out;
        const auto allowed =
            static_cast<std::ptrdiff_t>(pair.allowed_regions_listed(report.options));
        std::copy_n(of.allowed.begin(), allowed, out);
      });
}

}  // namespace strake::clash
