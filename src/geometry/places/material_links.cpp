// SPDX-License-Identifier: Apache-2.0
#include "geometry/places/material_links.hpp"

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "geometry/box.hpp"
#include "geometry/depth/nearest.hpp"

// Of a point x on the one skin, the points of the other body within reach are what a ball round x
// has of it. Its skin cuts the ball into pieces, and a straight line between two points in the ball
// stays in it: along the line pieces of skin follow each other, and those with material between
// them bound the same piece of the body. Since each piece of skin parts the ball in two, whatever
// bounds one piece of material is found along lines from any of them to the others.

namespace strake::geometry {
namespace {

/// Points tried for each set that a triangle is in.
constexpr std::size_t kTries = 8;

class MaterialLinks {
 public:
  MaterialLinks(const SolidNear& near, DisjointSets& sets, PairWork& work)
      : near_(near), sets_(sets), work_(work), stretches_(near, sets, work) {}

  /// The pairs of one triangle.
  std::size_t join(std::span<const std::uint32_t> group) {
    if (std::ranges::all_of(group, [&](std::uint32_t i) { return sets_.joined(group[0], i); }))
      return 0;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> by_set;
    for (const std::uint32_t i : group) by_set.emplace_back(sets_.root(i), i);
    std::ranges::sort(by_set);
    std::size_t joins = 0;
    for (std::size_t first = 0; first < by_set.size();) {
      std::size_t last = first;
      while (last < by_set.size() && by_set[last].first == by_set[first].first) ++last;
      const std::size_t size = last - first, tries = std::min(size, kTries);
      for (std::size_t k = 0; k < tries; ++k)
        joins += join_round(by_set[first + k * size / tries].second, group);
      first = last;
    }
    return joins;
  }

 private:
  /// Where another set of pairs comes near a point.
  struct Spot {
    std::uint32_t root = 0;
    double squared = 0;
    std::uint32_t pair = 0;
    Vec3d at;
  };

  [[nodiscard]] TriangleCorners other_corners(std::uint32_t pair) const {
    return near_.side.other.corners(near_.side.other_of(near_.pairs[pair]));
  }

  /// By set that the pair is not in: the spot nearest to x, within reach of it.
  [[nodiscard]] std::vector<Spot> spots_round(const Vec3d& x, std::uint32_t pair,
                                              std::span<const std::uint32_t> group) const {
    std::vector<Spot> spots;
    for (const std::uint32_t i : group) {
      if (sets_.joined(pair, i)) continue;
      const Corners t = as_doubles(other_corners(i));
      if (squared_gap({x, x}, box_of(t)) > near_.squared_reach()) continue;
      const Vec3d at = nearest_on_triangle(x, t), gap = at - x;
      if (dot(gap, gap) <= near_.squared_reach())
        spots.push_back({sets_.root(i), dot(gap, gap), i, at});
    }
    std::ranges::sort(spots, [](const Spot& s, const Spot& t) {
      return std::tie(s.root, s.squared, s.pair) < std::tie(t.root, t.squared, t.pair);
    });
    const auto rest = std::ranges::unique(spots, {}, &Spot::root);
    spots.erase(rest.begin(), rest.end());
    return spots;
  }

  /// Round the point of the own triangle that is nearest to the other one of a pair.
  std::size_t join_round(std::uint32_t pair, std::span<const std::uint32_t> group) {
    ++work_.exact_fallbacks;
    const NearTriangles& p = near_.pairs[pair];
    const NearestPoints nearest = exact_distance(near_.side.own.corners(near_.side.own_of(p)),
                                                 other_corners(pair), p.squared.upper);
    std::size_t joins = 0;
    for (const Spot& spot : spots_round(nearest.on_a, pair, group)) {
      const Line line{nearest.on_b, spot.at};
      constexpr double kMeets = Stretches::kMeets;
      joins += stretches_.join(line, stretches_.stops_on(line, group, kMeets * kMeets));
    }
    return joins;
  }

  SolidNear near_;
  DisjointSets& sets_;
  PairWork& work_;
  Stretches stretches_;
};

}  // namespace

std::size_t link_material(const SolidNear& near, DisjointSets& sets, PairWork& work) {
  MaterialLinks links(near, sets, work);
  std::size_t joins = 0;
  for (std::size_t r = 0; r + 1 < near.own.first.size(); ++r)
    joins += links.join(near.own.group(r));
  return joins;
}

}  // namespace strake::geometry
