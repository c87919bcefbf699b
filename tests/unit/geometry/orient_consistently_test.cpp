// SPDX-License-Identifier: Apache-2.0
// Closed surfaces of which some triangles face the other way.
#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/mesh_repair/mesh_repair.hpp"
#include "support/draw.hpp"
#include "support/grid_bodies.hpp"
#include "support/rounds.hpp"
#include "support/t_junctions.hpp"

namespace strake::geometry {
namespace {

using test::Draw;
using test::grid_box;

void turn(Triangle& t) { std::swap(t[1], t[2]); }

/// A box in which another is hollow.
GridMesh hollow() {
  GridMesh mesh = grid_box({0, 0, 0}, {9000, 9000, 9000}),
           inner = grid_box({3000, 3000, 3000}, {6000, 6000, 6000});
  for (Triangle& t : inner.triangles) turn(t);
  test::append(mesh, inner);
  return mesh;
}

bool same(const Part& a, const Part& b) {
  return a.kind == b.kind && a.vertices == b.vertices && a.triangles == b.triangles &&
         a.edge_triangles == b.edge_triangles && a.volume == b.volume && a.shells == b.shells;
}

TEST(OrientConsistently, FewerThanHalfOfThemAreTurnedBack) {
  for (const GridMesh& whole :
       {grid_box({0, 0, 0}, {1000, 2000, 3000}), test::grid_stair(5040), hollow()}) {
    const RepairedMesh right = repair_mesh(whole);
    ASSERT_EQ(right.parts.size(), 1U);
    EXPECT_EQ(right.findings.turned_triangles, 0U);
    for (std::uint64_t seed = 1; seed <= test::rounds(100U, 10'000U); ++seed) {
      SCOPED_TRACE(seed);
      Draw draw(seed);
      GridMesh mesh = whole;
      // Of either surface of the hollow box fewer than half of its 12.
      const std::size_t most = 1 + draw.below(5);
      for (std::size_t first = 0, n = 0; first + 12 <= mesh.triangles.size(); first += 12, n = 0)
        for (; n < most; ++n) turn(mesh.triangles[first + n * 12 / most]);
      const RepairedMesh found = repair_mesh(mesh);
      ASSERT_EQ(found.parts.size(), 1U);
      EXPECT_TRUE(same(found.parts[0], right.parts[0]));
      EXPECT_FALSE(found.parts[0].flags.open || found.parts[0].flags.inverted);
      EXPECT_EQ(found.findings.turned_triangles, whole.triangles.size() / 12 * most);
      // And all of it inside out.
      for (Triangle& t : mesh.triangles) turn(t);
      const RepairedMesh inside_out = repair_mesh(mesh);
      ASSERT_EQ(inside_out.parts.size(), 1U);
      EXPECT_TRUE(same(inside_out.parts[0], right.parts[0]));
      EXPECT_TRUE(inside_out.parts[0].flags.inverted);
      EXPECT_EQ(inside_out.findings.turned_triangles, found.findings.turned_triangles);
    }
  }
}

/// The connectivity of a mesh that needed it is not that of the next one.
TEST(OrientConsistently, IsReportedOfEachMeshOfManyAlike) {
  GridMesh mesh = grid_box({0, 0, 0}, {1000, 1000, 1000});
  turn(mesh.triangles[5]);
  MeshRepairer analyser;
  for (int i = 0; i < 4; ++i) {
    const RepairedMesh found = analyser.repair_mesh(mesh);
    EXPECT_EQ(found.findings.turned_triangles, 1U);
    EXPECT_EQ(found.parts.at(0).kind, PartKind::solid);
  }
}

TEST(OrientConsistently, OpenAndOneSidedSurfacesStayAsTheyAre) {
  GridMesh open = grid_box({0, 0, 0}, {1000, 1000, 1000});
  open.triangles.pop_back();
  turn(open.triangles[2]);
  for (const GridMesh& mesh : {open, test::one_sided_mesh()}) {
    const RepairedMesh found = repair_mesh(mesh);
    ASSERT_EQ(found.parts.size(), 1U);
    EXPECT_EQ(found.parts[0].kind, PartKind::sheet);
    EXPECT_EQ(found.parts[0].triangles.size(), mesh.triangles.size());
    EXPECT_EQ(found.findings.turned_triangles, 0U);
  }
}

}  // namespace
}  // namespace strake::geometry
