// SPDX-License-Identifier: Apache-2.0
#include "clash/regions.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

#include "strake/core/disjoint_sets.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/collect.hpp"

namespace strake::clash {
namespace {

using geometry::Box3d;

/// A place of one pair of parts.
struct Place {
  Pair result;
  Box3d box_mm;
  std::size_t candidate = 0;
};

struct Regions {
  std::uint32_t count = 0;
  std::vector<Region> worst = {};  ///< of several
};

/// Of a pair that does not have just one.
struct NotOne {
  std::size_t pair = 0;
  Regions regions;
};

Region region_of(const Place& place) {
  const Pair& p = place.result;
  return {.cls = p.cls,
          .flags = p.flags,
          .d_mm = p.d_mm,
          .d_lower_mm = p.d_lower_mm,
          .d_upper_mm = p.d_upper_mm,
          .point_mm = p.point_mm,
          .box_mm = place.box_mm,
          .part_a = p.part_a,
          .part_b = p.part_b};
}

/// Whether a place counts for a pair of objects with this answer.
bool counts(const Pair& place, const Pair& whole) {
  if ((place.allowed < 0) != (whole.allowed < 0)) return false;
  if (whole.cls == Class::clearance_violation) return place.cls == whole.cls;
  return place.cls >= Class::contact;
}

/// Of places that are as bad as each other, that of the pair's own witness counts as the worst.
bool worse(const Place& x, const Place& y, const Pair& whole) {
  const auto is_witness = [&](const Pair& p) {
    return p.part_a == whole.part_a && p.part_b == whole.part_b && p.d_mm == whole.d_mm &&
           p.point_mm == whole.point_mm;
  };
  if (is_witness(x.result) != is_witness(y.result)) return is_witness(x.result);
  return more_severe(x.result, y.result);
}

/// Places of different pairs of parts whose boxes meet are joined, in one sweep along x.
DisjointSets joined(const std::vector<Place>& places) {
  DisjointSets sets(places.size());
  std::vector<std::uint32_t> order(places.size()), open;
  std::iota(order.begin(), order.end(), std::uint32_t{0});
  std::ranges::sort(order, [&](std::uint32_t i, std::uint32_t j) {
    return std::pair(places[i].box_mm.lo.x, i) < std::pair(places[j].box_mm.lo.x, j);
  });
  for (const std::uint32_t i : order) {
    const Place& place = places[i];
    std::erase_if(open, [&](std::uint32_t j) { return places[j].box_mm.hi.x < place.box_mm.lo.x; });
    for (const std::uint32_t j : open)
      if (places[j].candidate != place.candidate && places[j].box_mm.meets(place.box_mm))
        sets.join(i, j);
    open.push_back(i);
  }
  return sets;
}

class RegionsOfPairs {
 public:
  explicit RegionsOfPairs(const PartFindings& findings, std::uint64_t most)
      : findings_(findings), most_(most) {}

  [[nodiscard]] Regions of(const Pair& pair) const {
    const std::size_t first = pair.first_region;
    if (!findings_.has_more(first))
      return {.count = findings_.found[first].too_near_to_tell ? 0U : 1U};
    std::vector<Place> places;
    for (std::size_t i = first; i < findings_.found.size() && findings_.same_objects(first, i);
         ++i) {
      const Found& found = findings_.found[i];
      Place place{findings_.pair(i), {}, found.candidate};
      if (!counts(place.result, pair)) continue;
      if (found.too_near_to_tell) return {};
      const double apart = std::max(place.result.d_upper_mm, 0.0) * geometry::kGridPerMm;
      place.box_mm = findings_.extent_mm(i).value_or(
          common_box_mm(findings_.a(i), findings_.b(i), search_reach(apart)));
      places.push_back(std::move(place));
    }
    if (places.size() < 2) return {.count = 1};
    return together(places, pair);
  }

 private:
  [[nodiscard]] Regions together(const std::vector<Place>& places, const Pair& whole) const {
    DisjointSets sets = joined(places);
    std::vector<Place> worst;
    std::vector<std::size_t> number(places.size());
    for (std::uint32_t i = 0; i < places.size(); ++i) {
      const std::uint32_t root = sets.root(i);
      if (root == i) {
        number[i] = worst.size();
        worst.push_back(places[i]);
        continue;
      }
      Place& known = worst[number[root]];
      Box3d box = known.box_mm;
      box.include(places[i].box_mm);
      if (worse(places[i], known, whole)) known = places[i];
      known.box_mm = box;
    }
    Regions regions{.count = static_cast<std::uint32_t>(worst.size())};
    if (regions.count < 2) return regions;
    std::ranges::sort(worst, [&](const Place& x, const Place& y) { return worse(x, y, whole); });
    worst.resize(std::min<std::uint64_t>(worst.size(), most_));
    for (const Place& place : worst) regions.worst.push_back(region_of(place));
    return regions;
  }

  const PartFindings& findings_;
  std::uint64_t most_;
};

}  // namespace

Status list_regions(const PartFindings& findings, const parallel::Context& context,
                    Report& report) {
  constexpr std::size_t kGrain = 256;
  const RegionsOfPairs regions(findings, report.options.most_regions);
  const auto others = parallel::collect<NotOne>(
      context, {.name = "regions", .n = report.pairs.size(), .grain = kGrain},
      [&](std::size_t i, std::vector<NotOne>& out) {
        Pair& pair = report.pairs[i];
        Regions of = regions.of(pair);
        pair.regions = of.count;
        pair.first_region = 0;
        if (of.count != 1) out.push_back({i, std::move(of)});
      });
  if (!others) return others.error();
  for (const NotOne& other : *others) {
    const std::vector<Region>& worst = other.regions.worst;
    report.pairs[other.pair].first_region = static_cast<std::uint32_t>(report.regions.size());
    report.regions.insert(report.regions.end(), worst.begin(), worst.end());
    if (other.regions.count == 0) ++report.counters.regions_given_up;
  }
  return {};
}

}  // namespace strake::clash
