// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/triangle_bvh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <stop_token>
#include <vector>

#include "geometry/contact_regions/contact_regions.hpp"
#include "geometry/obb/oriented_box.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/geometry/support_tree.hpp"
#include "strake/parallel/team.hpp"
#include "support/part_builder.hpp"
#include "support/revolved_meshes.hpp"

namespace strake::geometry {
namespace {

bool holds(const Box3i& box, const Vec3i& p) { return box.contains({p, p}); }

Part part_of(const TriangleMesh& mesh) {
  testing::IndexedMesh grid;
  grid.triangles = mesh.triangles;
  for (const Vec3d& v : mesh.vertices) grid.vertices.push_back(snap(v)->as<std::int32_t>());
  return testing::build_part(grid);
}

/// Every triangle in one leaf, every box round what is below it.
void expect_sound(const TriangleBvh& tree, const Part& part) {
  ASSERT_FALSE(tree.nodes().empty());
  std::vector<int> times_met(part.triangles.size(), 0);
  std::vector<std::uint32_t> todo{0};
  std::size_t visited = 0;
  while (!todo.empty()) {
    const TriangleBvh::Node& node = tree.nodes()[todo.back()];
    todo.pop_back();
    ++visited;
    if (node.count == 0) {
      for (const std::uint32_t child : {node.first, node.first + 1}) {
        ASSERT_LT(child, tree.nodes().size());
        ASSERT_TRUE(holds(node.box, tree.nodes()[child].box.lo) &&
                    holds(node.box, tree.nodes()[child].box.hi));
        todo.push_back(child);
      }
      continue;
    }
    ASSERT_LE(node.count, TriangleBvh::kLeafSize);
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      ++times_met[tree.order()[i]];
      for (const std::uint32_t v : part.triangles[tree.order()[i]])
        ASSERT_TRUE(holds(node.box, part.vertices[v]));
    }
  }
  EXPECT_EQ(visited, tree.nodes().size());
  EXPECT_EQ(times_met, std::vector<int>(part.triangles.size(), 1));
}

bool same(const TriangleBvh& x, const TriangleBvh& y) {
  if (x.order() != y.order() || x.nodes().size() != y.nodes().size()) return false;
  for (std::size_t i = 0; i < x.nodes().size(); ++i) {
    const TriangleBvh::Node &p = x.nodes()[i], &q = y.nodes()[i];
    if (p.first != q.first || p.count != q.count || p.box.lo != q.box.lo || p.box.hi != q.box.hi)
      return false;
  }
  return true;
}

TEST(TriangleBvh, IsSoundAndTheSameForAnyTeam) {
  // Few triangles, some, and so many that a team shares the work.
  for (const std::uint32_t rings : {2U, 5U, 40U, 150U}) {
    const Part part = part_of(test::bumpy_mesh(1000, 60, 12, rings));
    const TriangleBvh alone(part);
    expect_sound(alone, part);
    for (const unsigned threads : {1U, 2U, 3U, 8U}) {
      parallel::Team team(threads);
      EXPECT_TRUE(same(TriangleBvh(part, {.team = &team}), alone)) << rings << ", " << threads;
    }
  }
}

TEST(TriangleBvh, DoesNotDependOnTheOrderInWhichTrianglesAreListed) {
  const Part part = part_of(test::bumpy_mesh(1000, 60, 12, 40));
  std::vector<std::uint32_t> listed(part.triangles.size());
  std::iota(listed.begin(), listed.end(), 0U);
  const TriangleBvh tree(part, listed);
  std::mt19937 random(7);
  for (int round = 0; round < 3; ++round) {
    std::ranges::shuffle(listed, random);
    EXPECT_TRUE(same(TriangleBvh(part, listed), tree));
  }
}

TEST(TriangleBvh, IsEmptyWhenItWasStopped) {
  const Part part = part_of(test::sphere_mesh(1000, 150));
  const std::stop_source stop;
  stop.request_stop();
  EXPECT_TRUE(TriangleBvh(part, {.stop = stop.get_token()}).nodes().empty());
}

TEST(SupportTree, OfManyPointsGivesTheirGreatest) {
  const Part part = part_of(test::bumpy_mesh(1000, 60, 12, 190));
  parallel::Team team(3);
  const SupportTree tree(part.vertices, {.team = &team});
  for (const Vec3d& n : {Vec3d{1, 0, 0}, Vec3d{-0.3, 0.5, 0.8}, Vec3d{0, 0, -1}}) {
    double most = -1e300;
    for (const Vec3i& v : part.vertices) {
      const Vec3d p = v.as<double>();
      most = std::max(most, n.x * p.x + n.y * p.y + n.z * p.z);
    }
    EXPECT_EQ(tree.support_along(n).value, most);
  }
}

TEST(SupportTree, FindsThePointsInABox) {
  const Part part = part_of(test::bumpy_mesh(1000, 60, 12, 60));
  const SupportTree tree(part.vertices);
  const auto less = [](const Vec3i& x, const Vec3i& y) {
    return x.x != y.x ? x.x < y.x : x.y != y.y ? x.y < y.y : x.z < y.z;
  };
  for (const Box3d& box : {Box3d{{0, 0, 0}, {8e5, 8e5, 8e5}}, Box3d{{-2e6, -2e6, 0}, {2e6, 2e6, 0}},
                           Box3d{{-1e3, -1e3, -1e3}, {1e3, 1e3, 1e3}}}) {
    std::vector<Vec3i> expected;
    for (const Vec3i& v : part.vertices)
      if (box.contains({v.as<double>(), v.as<double>()})) expected.push_back(v);
    std::vector<Vec3i> found = tree.points_within(box, part.vertices.size());
    std::ranges::sort(expected, less);
    std::ranges::sort(found, less);
    EXPECT_EQ(found, expected);
    EXPECT_EQ(tree.points_within(box, 5).size(), std::min<std::size_t>(5, expected.size()));
  }
}

TEST(SupportTree, DoesNotDependOnTheOrderOfThePoints) {
  // Many of them are equally far in these directions, and at equal places along an axis.
  std::vector<Vec3i> points;
  for (std::int32_t x = 0; x < 9; ++x)
    for (std::int32_t y = 0; y < 9; ++y)
      for (std::int32_t z = 0; z < 9; ++z) points.push_back({x, y, z});
  const SupportTree tree(points);
  std::mt19937 random(7);
  for (int round = 0; round < 3; ++round) {
    std::ranges::shuffle(points, random);
    const SupportTree other(points);
    for (const Vec3d& n : {Vec3d{1, 0, 0}, Vec3d{0, -1, 1}, Vec3d{0, 0, -1}, Vec3d{}})
      EXPECT_EQ(other.support_along(n).vertex, tree.support_along(n).vertex);
    const Box3d box{{2, 2, 2}, {7, 7, 7}};
    EXPECT_EQ(other.points_within(box, 40), tree.points_within(box, 40));
  }
}

TEST(OrientedBox, OfManyVerticesHoldsThemAllTightly) {
  const Part part = part_of(test::bumpy_mesh(1000, 60, 12, 60));
  ASSERT_GE(part.vertices.size(), kManyVertices);
  const OrientedBox frame = make_oriented_box(part);
  for (std::size_t i = 0; i < 3; ++i) {
    double lo = 1e300, hi = -1e300;
    for (const Vec3i& v : part.vertices) {
      lo = std::min(lo, dot(frame.axis[i], v.as<double>()));
      hi = std::max(hi, dot(frame.axis[i], v.as<double>()));
    }
    EXPECT_EQ(frame.lo[i], lo);
    EXPECT_EQ(frame.hi[i], hi);
  }
}

TEST(OrientedBox, CommonExtentIsTheSameByATree) {
  const Part large = part_of(test::bumpy_mesh(1000, 60, 12, 60));
  const Part small = part_of(test::bumpy_mesh(300, 10, 5, 8));
  const TriangleBvh tree(large);
  const OrientedBox f = make_oriented_box(large), g = make_oriented_box(small);
  for (const std::int64_t at : {0, 500'000, 900'000}) {
    const PartWithObb b{{&small, {at, at / 2, 0}}, &g};
    const Box3d plain = overlap_extent({{&large, {}}, &f}, b, 1000);
    const Box3d by_tree = overlap_extent({{&large, {}}, &f, &tree}, b, 1000);
    EXPECT_EQ(by_tree.lo, plain.lo);
    EXPECT_EQ(by_tree.hi, plain.hi);
  }
}

}  // namespace
}  // namespace strake::geometry
