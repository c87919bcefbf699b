// SPDX-License-Identifier: Apache-2.0
#include "geometry/analyse/near_corners.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "geometry/box.hpp"
#include "strake/core/disjoint_sets.hpp"

namespace strake::geometry {
namespace {

/// The one nearest to the middle of their box, the first of several; nothing where another is too
/// far from it.
std::optional<std::uint32_t> middle_one(std::span<const Vec3i> vertices,
                                        std::span<const std::uint32_t> members,
                                        std::int64_t within) {
  Box3i box = empty_box<std::int32_t>();
  for (const std::uint32_t v : members) box.include(vertices[v]);
  const auto off_middle = [&](std::uint32_t v) {
    __int128 sum = 0;
    for (int k = 0; k < 3; ++k) {
      const std::int64_t off = 2 * std::int64_t{vertices[v][k]} - twice_centre(box, k);
      sum += __int128{off} * off;
    }
    return sum;
  };
  std::uint32_t at = members.front();
  for (const std::uint32_t v : members)
    if (off_middle(v) < off_middle(at)) at = v;
  const auto near = [&](std::uint32_t v) {
    return squared_distance(vertices[v], vertices[at]) <= __int128{within} * within;
  };
  if (!std::all_of(members.begin(), members.end(), near)) return std::nullopt;
  return at;
}

}  // namespace

std::vector<CornerCluster> near_corners(std::span<const Vec3i> vertices,
                                        std::span<const std::uint32_t> some,
                                        const NearPoints& points, std::int64_t within) {
  std::uint64_t boxes = NearPoints::boxes_for(some.size());
  const auto place = [&](std::uint32_t v) {
    return static_cast<std::uint32_t>(std::lower_bound(some.begin(), some.end(), v) - some.begin());
  };
  DisjointSets sets(some.size());
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < some.size(); ++i) {
    near.clear();
    const Vec3i& at = vertices[some[i]];
    if (!points.near(at, at, within, boxes, near)) return {};
    for (const std::uint32_t v : near) sets.join(i, place(v));
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> by_set;  // root, member
  for (std::uint32_t i = 0; i < some.size(); ++i) by_set.emplace_back(sets.root(i), some[i]);
  std::sort(by_set.begin(), by_set.end());
  std::vector<CornerCluster> clusters;
  for (std::size_t first = 0, end = 0; first < by_set.size(); first = end) {
    CornerCluster cluster;
    for (; end < by_set.size() && by_set[end].first == by_set[first].first; ++end)
      cluster.members.push_back(by_set[end].second);
    if (cluster.members.size() == 1) continue;
    const auto at = middle_one(vertices, cluster.members, within);
    if (!at) continue;
    cluster.at = *at;
    clusters.push_back(std::move(cluster));
  }
  return clusters;
}

}  // namespace strake::geometry
