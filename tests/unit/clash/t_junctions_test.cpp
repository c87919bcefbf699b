// SPDX-License-Identifier: Apache-2.0
// A body whose faces are cut otherwise on either side of their edges is the solid that it shows.
#include "support/t_junctions.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>

#include "strake/clash/clash.hpp"
#include "support/clash_model.hpp"
#include "support/revolved_meshes.hpp"
#include "support/rounds.hpp"

namespace strake::clash {
namespace {

using geometry::GridMesh;
using geometry::TriangleMesh;
using geometry::Vec3d;
using geometry::Vec3i;
using test::ClashModel;
using test::Draw;

TriangleMesh in_mm(const GridMesh& mesh) {
  TriangleMesh mm;
  for (const Vec3i& v : mesh.vertices) mm.vertices.push_back(v.as<double>() * 1e-3);
  mm.triangles = mesh.triangles;
  return mm;
}

GridMesh on_grid(const TriangleMesh& mesh) {
  GridMesh grid;
  for (const Vec3d& v : mesh.vertices) {
    const auto at = [](double x) { return static_cast<std::int32_t>(std::lround(x / 60)) * 60000; };
    grid.vertices.push_back({at(v.x), at(v.y), at(v.z)});
  }
  grid.triangles = mesh.triangles;
  return grid;
}

GridMesh split(GridMesh mesh, std::uint64_t seed) {
  Draw draw(seed);
  EXPECT_GT(test::split_sides(mesh, 80, draw), 0);
  return mesh;
}

/// A cylinder whose corners stand on a lattice of 60 mm, so that its edges have points between.
GridMesh cylinder() { return on_grid(test::cylinder_mesh(3000, 6000, 2, 16)); }
GridMesh cube() { return test::grid_box({0, 0, 0}, {1'200'000, 1'200'000, 1'200'000}); }

Report clash(const GridMesh& a, const GridMesh& b, const Vec3d& at) {
  ClashModel m;
  m.object("a").body(in_mm(a)).object("b").body(in_mm(b), {{}, at});
  return m.detect({.tolerances = {.clearance_mm = 300}});
}

TEST(TJunctionClashes, ABodyBuriedInOneIsFound) {
  const GridMesh small = test::grid_box({0, 0, 0}, {100'000, 100'000, 100'000});
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const auto& [body, at] :
         {std::pair(cube(), Vec3d{400, 500, 600}), std::pair(cylinder(), Vec3d{600, 300, 3000})}) {
      const Report r = clash(small, split(body, seed), at * -1);
      ASSERT_EQ(r.pairs.size(), 1U) << seed;
      EXPECT_EQ(r.pairs[0].cls, Class::hit);
      EXPECT_EQ(r.pairs[0].relation, Relation::a_in_b);
      EXPECT_EQ(r.pairs[0].flags & kOpen, 0);
    }
}

TEST(TJunctionClashes, TheSameAsWithoutThem) {
  int met = 0;
  for (std::uint64_t seed = 1; seed <= test::rounds(60U, 6'000U); ++seed) {
    Draw draw(seed);
    const GridMesh body = seed % 2 == 0 ? cube() : cylinder();
    const GridMesh other = test::grid_box(
        {0, 0, 0}, {draw.whole(1, 9) * 120'000, draw.whole(1, 9) * 120'000, 360'000});
    const Vec3d at{double{60} * draw.whole(-60, 60), double{60} * draw.whole(-60, 60),
                   double{60} * draw.whole(-10, 100)};
    const Report whole = clash(body, other, at);
    const Report cut = clash(split(body, seed), split(other, seed + 1), at);
    ASSERT_EQ(whole.pairs.size(), cut.pairs.size()) << seed;
    for (std::size_t i = 0; i < whole.pairs.size(); ++i) {
      ++met;
      const Pair &p = whole.pairs[i], &q = cut.pairs[i];
      EXPECT_EQ(p.cls, q.cls) << seed;
      EXPECT_EQ(p.relation, q.relation) << seed;
      EXPECT_EQ(p.flags, q.flags) << seed;
      EXPECT_NEAR(p.d_mm, q.d_mm, 0.01 + 0.02 * std::abs(p.d_mm)) << seed;
    }
  }
  EXPECT_GT(met, 15);
}

TEST(TJunctionClashes, ABoxWithoutALidIsOpenAllTheSame) {
  GridMesh open = cube();
  std::erase_if(open.triangles, [&](const geometry::Triangle& t) {
    return open.vertices[t[0]].z + open.vertices[t[1]].z + open.vertices[t[2]].z == 3'600'000;
  });
  const GridMesh small = test::grid_box({0, 0, 0}, {100'000, 100'000, 100'000});
  const Report r = clash(split(open, 1), small, {500, 500, 200});
  ASSERT_EQ(r.pairs.size(), 1U);
  EXPECT_EQ(r.pairs[0].cls, Class::clearance_violation);
  EXPECT_NE(r.pairs[0].flags & kOpen, 0);
}

}  // namespace
}  // namespace strake::clash
