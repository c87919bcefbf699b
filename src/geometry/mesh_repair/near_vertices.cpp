// SPDX-License-Identifier: Apache-2.0
#include "geometry/mesh_repair/near_vertices.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "core/parting.hpp"
#include "core/union_find.hpp"
#include "geometry/numeric/vector_math.hpp"

namespace strake::geometry {
namespace {

using WideProduct = __int128;

WideProduct wide_dot(const Vec3l& a, const Vec3l& b) {
  return WideProduct{a.x} * b.x + WideProduct{a.y} * b.y + WideProduct{a.z} * b.z;
}

/// Whether a box that is larger by `within` on all sides may meet a segment: false only where an
/// axis, or the product of one with the segment, parts the two by more than what doubles round.
bool may_meet(const Box3i& box, const Vec3i& a, const Vec3i& b, std::int64_t within) {
  // All twice as large, so that middles are whole: exact, since doubles hold 53 bits.
  const Vec3d half = (box.hi.as<double>() - box.lo.as<double>()) +
                     Vec3d{1, 1, 1} * (2 * static_cast<double>(within));
  const Vec3d way = b.as<double>() - a.as<double>();
  const Vec3d off = (box.hi.as<double>() + box.lo.as<double>()) - (a.as<double>() + b.as<double>());
  const Vec3d along{std::fabs(way.x), std::fabs(way.y), std::fabs(way.z)};
  for (int k = 0; k < 3; ++k)
    if (std::fabs(off[k]) > half[k] + along[k]) return false;
  constexpr double kRounding = 0x1p20;  // of products below 2^67
  const Vec3d turned = cross(off, way);
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    if (std::fabs(turned[k]) > half[i] * along[j] + half[j] * along[i] + kRounding) return false;
  }
  return true;
}

}  // namespace

__int128 squared_distance(const Vec3i& p, const Vec3i& q) {
  const Vec3l way = q.as<std::int64_t>() - p.as<std::int64_t>();
  return wide_dot(way, way);
}

bool is_near_segment(const Vec3i& p, const Vec3i& a, const Vec3i& b, std::int64_t within) {
  const Vec3l from = a.as<std::int64_t>();
  const Vec3l to = p.as<std::int64_t>() - from, way = b.as<std::int64_t>() - from;
  const WideProduct along = wide_dot(to, way), length = wide_dot(way, way),
                    largest = WideProduct{within} * within;
  if (along <= 0) return wide_dot(to, to) <= largest;
  if (along >= length) return squared_distance(p, b) <= largest;
  const auto minor = [&](int i, int j) {
    return WideProduct{to[i]} * way[j] - WideProduct{to[j]} * way[i];
  };
  WideProduct sum = 0;
  for (int k = 0; k < 3; ++k) {
    const WideProduct m = minor((k + 1) % 3, (k + 2) % 3);
    // Beyond `within` times the length of any segment; squares below fit.
    constexpr WideProduct kFar = WideProduct{1} << 60U;
    if (m > kFar || m < -kFar) return false;
    sum += m * m;
  }
  return sum <= largest * length;
}

NearPoints::NearPoints(std::span<const Vec3i> vertices, std::vector<std::uint32_t> some)
    : vertices_(vertices), points_(std::move(some)) {
  if (points_.empty()) return;
  nodes_.push_back({{}, 0, static_cast<std::uint32_t>(points_.size()), 0});
  for (std::size_t n = 0; n < nodes_.size(); ++n) split(n);
}

void NearPoints::split(std::size_t node) {
  // Between 2 and 32 ships show no difference (decision 0073).
  constexpr std::uint32_t kLeaf = 8;
  const std::span<std::uint32_t> points =
      std::span(points_).subspan(nodes_[node].first, nodes_[node].count);
  Box3i box = empty_box<std::int32_t>();
  for (const std::uint32_t p : points) box.include(vertices_[p]);
  nodes_[node].box = box;
  if (points.size() <= kLeaf) {
    std::ranges::sort(points);
    return;
  }
  const auto side = [&](int k) { return std::int64_t{box.hi[k]} - box.lo[k]; };
  int axis = side(1) > side(0) ? 1 : 0;
  if (side(2) > side(axis)) axis = 2;
  const std::uint32_t first = nodes_[node].first, count = nodes_[node].count, half = count / 2;
  part_at(points, half, [&](std::uint32_t p, std::uint32_t q) {
    const std::int32_t x = vertices_[p][axis], y = vertices_[q][axis];
    return x != y ? x < y : p < q;
  });
  nodes_[node].left = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({{}, first, half, 0});
  nodes_.push_back({{}, first + half, count - half, 0});
}

bool NearPoints::near(const Vec3i& a, const Vec3i& b, std::int64_t within, std::uint64_t& boxes,
                      std::vector<std::uint32_t>& found) const {
  if (nodes_.empty()) return true;
  constexpr std::size_t kDeepest = 64;  // halves of at most 2^32 points, one waiting at each level
  std::array<std::uint32_t, kDeepest> waiting{};
  for (std::size_t count = 1; count > 0;) {
    if (boxes == 0) return false;
    --boxes;
    const Node& node = nodes_[waiting[--count]];
    if (!may_meet(node.box, a, b, within)) continue;
    if (node.left != 0) {
      waiting[count++] = node.left;
      waiting[count++] = node.left + 1;
      continue;
    }
    for (const std::uint32_t p : std::span(points_).subspan(node.first, node.count))
      if (is_near_segment(vertices_[p], a, b, within)) found.push_back(p);
  }
  return true;
}

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

std::vector<VertexCluster> cluster_near_vertices(std::span<const Vec3i> vertices,
                                                 std::span<const std::uint32_t> some,
                                                 const NearPoints& points, std::int64_t within) {
  std::uint64_t boxes = NearPoints::boxes_for(some.size());
  const auto place = [&](std::uint32_t v) {
    return static_cast<std::uint32_t>(std::lower_bound(some.begin(), some.end(), v) - some.begin());
  };
  UnionFind sets(some.size());
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
  std::vector<VertexCluster> clusters;
  for (std::size_t first = 0, end = 0; first < by_set.size(); first = end) {
    VertexCluster cluster;
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
