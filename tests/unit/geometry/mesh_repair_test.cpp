// SPDX-License-Identifier: Apache-2.0
#include "geometry/mesh_repair/mesh_repair.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <utility>
#include <vector>

#include "geometry/mesh_repair/snap_to_grid.hpp"
#include "strake/geometry/triangulate.hpp"
#include "support/meshes.hpp"

namespace strake::geometry {
namespace {

using test::add_box;
using test::box_mesh;

RepairedMesh analysed(const TriangleMesh& mesh, const Mat3d& linear = {}) {
  auto placed = snap_to_grid(mesh, linear);
  EXPECT_TRUE(placed.has_value());
  return repair_mesh(std::move(placed->mesh));
}

/// Of all its parts, cubic grid units.
double volume_of(const RepairedMesh& analysis) {
  double volume = 0;
  for (const Part& part : analysis.parts) volume += part.volume;
  return volume;
}

bool same(const Part& a, const Part& b) {
  return a.kind == b.kind && a.vertices == b.vertices && a.triangles == b.triangles &&
         a.edge_triangles == b.edge_triangles && a.shells == b.shells && a.box == b.box &&
         a.volume == b.volume && a.area == b.area;
}

TEST(MeshRepair, BoxIsOneSolid) {
  const RepairedMesh a = analysed(box_mesh({0, 0, 0}, {1, 2, 3}));
  ASSERT_EQ(a.parts.size(), 1U);
  const Part& p = a.parts[0];
  EXPECT_EQ(p.kind, PartKind::solid);
  EXPECT_EQ(p.vertices.size(), 8U);
  EXPECT_EQ(p.triangles.size(), 12U);
  EXPECT_EQ(p.edges.size(), 18U + 1U);
  EXPECT_EQ(p.edge_triangles.size(), 36U);
  EXPECT_EQ(p.shell_count, 1U);
  EXPECT_DOUBLE_EQ(p.volume, 6e9);
  EXPECT_DOUBLE_EQ(p.area, 22e6);
  EXPECT_FALSE(p.flags.inverted || p.flags.open || p.flags.non_manifold);
  EXPECT_EQ(p.box, (Box3i{{-500, -1000, -1500}, {500, 1000, 1500}}));
}

TEST(MeshRepair, UnweldedSoupOfABoxIsTheSameSolid) {
  const TriangleMesh box = box_mesh({0, 0, 0}, {1, 2, 3});
  TriangleMesh soup;
  for (const Triangle& t : box.triangles) {
    const auto base = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t v : t) soup.vertices.push_back(box.vertices[v]);
    soup.triangles.push_back({base + 1, base + 2, base});
  }
  std::mt19937 random(7);
  std::shuffle(soup.triangles.begin(), soup.triangles.end(), random);
  EXPECT_TRUE(same(analysed(box).parts.at(0), analysed(soup).parts.at(0)));
}

TEST(MeshRepair, InsideOutBoxIsTurned) {
  const RepairedMesh a = analysed(box_mesh({0, 0, 0}, {1, 1, 1}, true));
  ASSERT_EQ(a.parts.size(), 1U);
  EXPECT_TRUE(a.parts[0].flags.inverted);
  EXPECT_GT(a.parts[0].volume, 0);
  EXPECT_TRUE(same(a.parts[0], analysed(box_mesh({0, 0, 0}, {1, 1, 1})).parts.at(0)));
}

TEST(MeshRepair, MirroredPlacementIsNotInverted) {
  Mat3d mirror;
  mirror.row[0].x = -1;
  const RepairedMesh a = analysed(box_mesh({0, 0, 0}, {1, 1, 1}), mirror);
  EXPECT_FALSE(a.parts.at(0).flags.inverted);
  EXPECT_GT(a.parts.at(0).volume, 0);
}

TEST(MeshRepair, DisjointBoxesAreSeparateParts) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  add_box(mesh, {3, 0, 0}, {4, 1, 1}, true);
  const RepairedMesh a = analysed(mesh);
  ASSERT_EQ(a.parts.size(), 2U);
  EXPECT_FALSE(a.parts[0].flags.inverted);
  EXPECT_TRUE(a.parts[1].flags.inverted);
}

TEST(MeshRepair, BoxesThatShareAnEdgeOrACornerComeApart) {
  for (const Vec3d& shift : {Vec3d{1, 1, 0}, Vec3d{1, 1, 1}}) {
    TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
    add_box(mesh, shift, Vec3d{1, 1, 1} + shift, true);
    const RepairedMesh a = analysed(mesh);
    ASSERT_EQ(a.parts.size(), 2U) << shift.x << shift.y << shift.z;
    for (const Part& p : a.parts) {
      EXPECT_EQ(p.kind, PartKind::solid);
      EXPECT_EQ(p.triangles.size(), 12U);
      EXPECT_DOUBLE_EQ(p.volume, 1e9);
      EXPECT_FALSE(p.flags.non_manifold);
    }
  }
}

TEST(MeshRepair, BoxesThatShareAFaceComeApart) {
  for (int axis = 0; axis < 3; ++axis) {
    TriangleMesh mesh;
    for (int i = 0; i < 4; ++i) {  // a row, then one across it: edges with four and six triangles
      Vec3d lo{0, 0, 0};
      lo[i < 3 ? axis : (axis + 1) % 3] = i < 3 ? i : 1;
      add_box(mesh, lo, lo + Vec3d{1, 1, 1});
    }
    const RepairedMesh a = analysed(mesh);
    ASSERT_EQ(a.parts.size(), 4U);
    for (const Part& p : a.parts) {
      EXPECT_EQ(p.kind, PartKind::solid);
      EXPECT_DOUBLE_EQ(p.volume, 1e9);
      EXPECT_FALSE(p.flags.non_manifold);
    }
  }
}

TEST(MeshRepair, BlockOfCubesComesApartIntoCubes) {
  TriangleMesh mesh;
  for (int i = 0; i < 27; ++i) {
    const Vec3d lo{static_cast<double>(i % 3), static_cast<double>(i / 3 % 3),
                   static_cast<double>(i / 9 % 3)};
    add_box(mesh, lo, lo + Vec3d{1, 1, 1});
  }
  const RepairedMesh a = analysed(mesh);
  EXPECT_EQ(a.parts.size(), 27U);
  for (const Part& p : a.parts) EXPECT_DOUBLE_EQ(p.volume, 1e9);
}

TEST(MeshRepair, FinOfNoThicknessIsASheetBesideItsSolid) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  add_box(mesh, {1, 0, 1}, {2, 1, 1});
  const RepairedMesh a = analysed(mesh);
  ASSERT_EQ(a.parts.size(), 2U);
  EXPECT_EQ(a.parts[0].kind, PartKind::solid);
  EXPECT_EQ(a.parts[1].kind, PartKind::sheet);
  EXPECT_EQ(a.parts[1].triangles.size(), 2U);
}

TEST(MeshRepair, CavityBelongsToItsSolid) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {4, 4, 4});
  add_box(mesh, {1, 1, 1}, {2, 2, 2}, true);
  const RepairedMesh a = analysed(mesh);
  ASSERT_EQ(a.parts.size(), 1U);
  EXPECT_EQ(a.parts[0].shell_count, 2U);
  EXPECT_EQ(a.parts[0].triangles.size(), 24U);
  EXPECT_DOUBLE_EQ(a.parts[0].volume, 63e9);
  EXPECT_EQ(a.findings.nested_shells, 0U);
}

TEST(MeshRepair, HollowBodyInsideOutIsTurnedAsAWhole) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {4, 4, 4}, true);
  add_box(mesh, {1, 1, 1}, {2, 2, 2}, false);
  const RepairedMesh a = analysed(mesh);
  ASSERT_EQ(a.parts.size(), 1U);
  EXPECT_TRUE(a.parts[0].flags.inverted);
  EXPECT_DOUBLE_EQ(a.parts[0].volume, 63e9);
}

TEST(MeshRepair, SolidInsideASolidIsLeftOut) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {4, 4, 4});
  add_box(mesh, {1, 1, 1}, {2, 2, 2});
  const RepairedMesh a = analysed(mesh);
  ASSERT_EQ(a.parts.size(), 1U);
  EXPECT_EQ(a.parts[0].triangles.size(), 12U);
  EXPECT_DOUBLE_EQ(a.parts[0].volume, 64e9);
  EXPECT_EQ(a.findings.nested_shells, 1U);
}

TEST(MeshRepair, IslandInACavityBelongsToTheNest) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {8, 8, 8});
  add_box(mesh, {1, 1, 1}, {7, 7, 7}, true);
  add_box(mesh, {2, 2, 2}, {6, 6, 6});
  add_box(mesh, {3, 3, 3}, {5, 5, 5});  // solid in the island: bounds nothing
  const RepairedMesh a = analysed(mesh);
  ASSERT_EQ(a.parts.size(), 1U);
  EXPECT_EQ(a.parts[0].shell_count, 3U);
  EXPECT_DOUBLE_EQ(a.parts[0].volume, (512 - 216 + 64) * 1e9);
  EXPECT_EQ(a.findings.nested_shells, 1U);
}

TEST(MeshRepair, CrossingSolidsStaySeparate) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {4, 4, 4});
  add_box(mesh, {1, 1, -1}, {2, 2, 5});
  EXPECT_EQ(analysed(mesh).parts.size(), 2U);
}

TEST(MeshRepair, SolidThatPiercesADentIsNotNested) {
  // Every corner of the small box lies in the large one, which has a notch that it crosses.
  TriangleMesh mesh;
  const std::vector<Vec3d> outline{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {6, 9, 0},
                                   {6, 3, 0}, {3, 3, 0}, {3, 9, 0}, {0, 9, 0}};
  const FaceTriangles cap = triangulate_face(outline);
  ASSERT_EQ(cap.fault, FaceFault::none);
  const auto count = static_cast<std::uint32_t>(outline.size());
  for (const double z : {0.0, 9.0})
    for (const Vec3d& v : outline) mesh.vertices.push_back(v + Vec3d{0, 0, z});
  for (const Triangle& t : cap.triangles) {
    mesh.triangles.push_back({t[0], t[2], t[1]});
    mesh.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t k = (i + 1) % count;
    mesh.triangles.push_back({i, k, k + count});
    mesh.triangles.push_back({i, k + count, i + count});
  }
  EXPECT_EQ(analysed(mesh).parts.size(), 1U);
  add_box(mesh, {1, 5, 2}, {8, 7, 5});
  const RepairedMesh a = analysed(mesh);
  EXPECT_EQ(a.parts.size(), 2U);
  EXPECT_EQ(a.findings.nested_shells, 0U);
}

TEST(MeshRepair, ManyShellsInOneHullNestQuickly) {
  TriangleMesh mesh = box_mesh({-1, -1, -1}, {61, 61, 61});
  for (int x = 0; x < 20; ++x)
    for (int y = 0; y < 20; ++y)
      for (int z = 0; z < 20; ++z) {
        const Vec3d lo{3.0 * x, 3.0 * y, 3.0 * z};
        add_box(mesh, lo, lo + Vec3d{2, 2, 2}, true);
      }
  const RepairedMesh a = analysed(mesh);
  ASSERT_EQ(a.parts.size(), 1U);
  EXPECT_EQ(a.parts[0].shell_count, 8001U);
  EXPECT_DOUBLE_EQ(a.parts[0].volume, (62.0 * 62 * 62 - 8000 * 8) * 1e9);
}

TEST(MeshRepair, CavityThatTouchesTheSkinIsStillInside) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {4, 4, 4});
  add_box(mesh, {1, 1, 0}, {2, 2, 2}, true);  // a blind hole drawn as a cavity flush with the skin
  const RepairedMesh a = analysed(mesh);
  ASSERT_EQ(a.parts.size(), 1U);
  EXPECT_DOUBLE_EQ(a.parts[0].volume, 62e9);
}

/// Adds the sides of a quadrilateral: its front, and its back where asked, that with the other
/// diagonal where asked too.
void add_quad(TriangleMesh& mesh, const std::array<Vec3d, 4>& corners, bool back = false,
              bool other_diagonal = false) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.triangles.push_back({base + a, base + b, base + c});
  };
  add(0, 1, 2);
  add(0, 2, 3);
  if (!back) return;
  if (other_diagonal) {
    add(0, 3, 1);
    add(1, 3, 2);
  } else {
    add(0, 2, 1);
    add(0, 3, 2);
  }
}

/// The same box, every face cut along its other diagonal.
void add_recut_box(TriangleMesh& mesh, const Vec3d& lo, const Vec3d& hi, bool inside_out = false) {
  TriangleMesh box = box_mesh(lo, hi, inside_out);
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), box.vertices.begin(), box.vertices.end());
  for (std::size_t i = 0; i < box.triangles.size(); i += 2) {
    // A quad (a, b, c, d) comes as (a, b, c) and (a, c, d), inside out as (a, c, b) and (a, d, c).
    const Triangle &s = box.triangles[i], &t = box.triangles[i + 1];
    const std::uint32_t a = base + s[0], b = base + (inside_out ? s[2] : s[1]),
                        c = base + (inside_out ? s[1] : s[2]),
                        d = base + (inside_out ? t[1] : t[2]);
    mesh.triangles.push_back(inside_out ? Triangle{b, a, d} : Triangle{a, b, d});
    mesh.triangles.push_back(inside_out ? Triangle{c, b, d} : Triangle{b, c, d});
  }
}

void add_two_sided_box(TriangleMesh& mesh, const Vec3d& lo, const Vec3d& hi) {
  add_box(mesh, lo, hi);
  add_box(mesh, lo, hi, true);
}

void expect_solids(const RepairedMesh& a, const std::vector<double>& cubic_millimetres) {
  ASSERT_EQ(a.parts.size(), cubic_millimetres.size());
  for (std::size_t i = 0; i < a.parts.size(); ++i) {
    EXPECT_EQ(a.parts[i].kind, PartKind::solid);
    EXPECT_DOUBLE_EQ(a.parts[i].volume, cubic_millimetres[i] * 1e9);
    EXPECT_FALSE(a.parts[i].flags.inverted);
  }
}

TEST(MeshRepair, SkinDrawnFromBothSidesIsTheSolidInIt) {
  TriangleMesh mesh;
  add_two_sided_box(mesh, {0, 0, 0}, {4, 4, 4});
  const RepairedMesh a = analysed(mesh);
  expect_solids(a, {64});
  EXPECT_TRUE(same(a.parts.at(0), analysed(box_mesh({0, 0, 0}, {4, 4, 4})).parts.at(0)));
  EXPECT_EQ(a.findings.two_sided_shells, 1U);
  EXPECT_EQ(a.findings.nested_shells, 0U);
}

TEST(MeshRepair, SidesMayBeCutDifferently) {
  for (const bool front_first : {true, false}) {
    TriangleMesh mesh = box_mesh({0, 0, 0}, {4, 4, 4}, !front_first);
    add_recut_box(mesh, {0, 0, 0}, {4, 4, 4}, front_first);
    const RepairedMesh a = analysed(mesh);
    expect_solids(a, {64});
    EXPECT_EQ(a.parts.at(0).triangles.size(), 12U);
    EXPECT_EQ(a.findings.two_sided_shells, 1U);
  }
}

TEST(MeshRepair, SidesCutDifferentlyAskewDoNotFallIntoSlivers) {
  // The snap takes each face off its plane: its two sides no longer coincide.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int round = 0; round < 40; ++round) {
    const double w = any(random), x = any(random), y = any(random), z = any(random);
    const double s = 2 / (w * w + x * x + y * y + z * z);
    const Mat3d turn{{{{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
                       {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
                       {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}}}};
    TriangleMesh mesh = box_mesh({0, 0, 0}, {40, 50, 60});
    add_recut_box(mesh, {0, 0, 0}, {40, 50, 60}, true);
    const RepairedMesh a = analysed(mesh, turn);
    ASSERT_FALSE(a.parts.empty()) << round;
    for (const Part& p : a.parts) {
      EXPECT_EQ(p.kind, PartKind::solid) << round;
      EXPECT_NEAR(p.volume, 120'000e9, 1e11) << round;
    }
  }
}

TEST(MeshRepair, CavityInASkinDrawnFromBothSidesStays) {
  TriangleMesh mesh;
  add_two_sided_box(mesh, {0, 0, 0}, {4, 4, 4});
  add_box(mesh, {1, 1, 1}, {2, 2, 2}, true);
  const RepairedMesh a = analysed(mesh);
  expect_solids(a, {63});
  EXPECT_EQ(a.findings.two_sided_shells, 1U);
}

TEST(MeshRepair, IslandDrawnFromBothSidesIsSolid) {
  for (const bool inverted : {false, true}) {
    TriangleMesh mesh = box_mesh({0, 0, 0}, {8, 8, 8}, inverted);
    add_box(mesh, {1, 1, 1}, {7, 7, 7}, !inverted);
    add_two_sided_box(mesh, {2, 2, 2}, {6, 6, 6});
    const RepairedMesh a = analysed(mesh);
    ASSERT_EQ(a.parts.size(), 1U);
    EXPECT_DOUBLE_EQ(a.parts[0].volume, (512 - 216 + 64) * 1e9);
    EXPECT_EQ(a.parts[0].flags.inverted, inverted);
    EXPECT_EQ(a.findings.two_sided_shells, 1U);
  }
}

TEST(MeshRepair, CavityThatAHollowBodyFillsStaysACavity) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {8, 8, 8});
  add_two_sided_box(mesh, {1, 1, 1}, {7, 7, 7});
  add_box(mesh, {2, 2, 2}, {6, 6, 6}, true);
  const RepairedMesh a = analysed(mesh);
  expect_solids(a, {512 - 64});
  EXPECT_EQ(a.findings.two_sided_shells, 0U);
}

TEST(MeshRepair, BoxesDrawnFromBothSidesMayShareAnEdgeOrAFace) {
  for (const Vec3d& shift : {Vec3d{4, 0, 0}, Vec3d{4, 4, 0}, Vec3d{4, 4, 4}, Vec3d{9, 0, 0}}) {
    TriangleMesh mesh;
    add_two_sided_box(mesh, {0, 0, 0}, {4, 4, 4});
    add_two_sided_box(mesh, shift, Vec3d{4, 4, 4} + shift);
    const RepairedMesh a = analysed(mesh);
    expect_solids(a, {64, 64});
    EXPECT_GE(a.findings.two_sided_shells, 1U);
  }
}

TEST(MeshRepair, ShellsThatCancelLeaveTheirSkin) {
  // At the common edge the far sides of the two boxes join, and cut otherwise than their fronts.
  TriangleMesh mesh;
  for (const Vec3d& shift : {Vec3d{0, 0, 0}, Vec3d{4, 4, 0}}) {
    add_box(mesh, shift, Vec3d{4, 4, 4} + shift);
    add_recut_box(mesh, shift, Vec3d{4, 4, 4} + shift, true);
  }
  const RepairedMesh a = analysed(mesh);
  EXPECT_DOUBLE_EQ(volume_of(a), 128e9);
  EXPECT_GE(a.findings.two_sided_shells, 1U);
}

TEST(MeshRepair, FlapOnASkinDrawnFromBothSidesStays) {
  TriangleMesh mesh;
  add_two_sided_box(mesh, {0, 0, 0}, {4, 4, 4});
  add_quad(mesh, {{{4, 0, 4}, {6, 0, 4}, {6, 4, 4}, {4, 4, 4}}}, true);
  const RepairedMesh a = analysed(mesh);
  ASSERT_EQ(a.parts.size(), 2U);
  EXPECT_DOUBLE_EQ(a.parts[0].volume, 64e9);
  EXPECT_EQ(a.parts[1].kind, PartKind::sheet);
  EXPECT_DOUBLE_EQ(a.parts[1].area, 8e6);
}

TEST(MeshRepair, SheetCutDifferentlyOnItsTwoSidesIsASheet) {
  TriangleMesh mesh;
  add_quad(mesh, {{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}}, true, true);
  const RepairedMesh a = analysed(mesh);
  ASSERT_EQ(a.parts.size(), 1U);
  EXPECT_EQ(a.parts[0].kind, PartKind::sheet);
}

TEST(MeshRepair, CubesInsideOutStandSideBySide) {
  // The middle one has another's triangle on each of its own: nothing of it is a far side.
  for (const bool inside_out : {false, true}) {
    TriangleMesh mesh;
    for (int i = 0; i < 27; ++i) {
      const Vec3d lo{static_cast<double>(i % 3), static_cast<double>(i / 3 % 3),
                     static_cast<double>(i / 9 % 3)};
      add_box(mesh, lo, lo + Vec3d{1, 1, 1}, inside_out);
    }
    const RepairedMesh a = analysed(mesh);
    EXPECT_DOUBLE_EQ(volume_of(a), 27e9);
    EXPECT_EQ(a.findings.two_sided_shells, 0U);
  }
}

TEST(MeshRepair, OpenBoxIsASheet) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  mesh.triangles.pop_back();
  const RepairedMesh a = analysed(mesh);
  ASSERT_EQ(a.parts.size(), 1U);
  EXPECT_EQ(a.parts[0].kind, PartKind::sheet);
  EXPECT_TRUE(a.parts[0].flags.open);
  EXPECT_EQ(a.parts[0].volume, 0);
  EXPECT_GT(a.parts[0].area, 0);
}

TEST(MeshRepair, FlippedTriangleIsTurnedBack) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  const RepairedMesh a = analysed(mesh);
  EXPECT_EQ(a.parts.at(0).kind, PartKind::solid);
  EXPECT_EQ(a.findings.turned_triangles, 1U);
}

TEST(MeshRepair, FlatBoxIsASheetOfOneLayer) {
  const RepairedMesh a = analysed(box_mesh({0, 0, 0}, {3, 2, 0}));
  ASSERT_EQ(a.parts.size(), 1U);
  EXPECT_EQ(a.parts[0].kind, PartKind::sheet);
  EXPECT_DOUBLE_EQ(a.parts[0].area, 6e6 * static_cast<double>(a.parts[0].triangles.size()) / 2);
  EXPECT_EQ(a.findings.degenerate_triangles, 8U);
}

TEST(MeshRepair, RepeatedMeshIsOneSolid) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  add_box(mesh, {0, 0, 0}, {1, 1, 1});
  const RepairedMesh a = analysed(mesh);
  ASSERT_EQ(a.parts.size(), 1U);
  EXPECT_EQ(a.parts[0].triangles.size(), 12U);
  EXPECT_EQ(a.findings.duplicate_triangles, 12U);
}

TEST(MeshRepair, DegenerateTrianglesAreDroppedExactly) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  mesh.vertices.push_back({0.5, 0, 0});
  mesh.triangles.push_back({0, 8, 1});  // collinear
  mesh.triangles.push_back({0, 0, 5});
  const RepairedMesh a = analysed(mesh);
  EXPECT_EQ(a.findings.degenerate_triangles, 2U);
  EXPECT_EQ(a.parts.at(0).kind, PartKind::solid);
  EXPECT_EQ(a.parts.at(0).vertices.size(), 8U);
}

TEST(MeshRepair, BadIndicesAndPlacesAreLeftOutAndCounted) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  mesh.vertices.push_back({std::numeric_limits<double>::quiet_NaN(), 0, 0});
  mesh.vertices.push_back({1e30, 0, 0});
  mesh.triangles.push_back({0, 1, 8});
  mesh.triangles.push_back({0, 1, 9});
  mesh.triangles.push_back({0, 1, 77});
  const auto placed = snap_to_grid(mesh, {});
  ASSERT_TRUE(placed.has_value());
  EXPECT_EQ(placed->bad_triangles, 3U);
  EXPECT_EQ(placed->mesh.triangles.size(), 12U);
}

TEST(Place, FarShapesGetABaseThatKeepsEveryVertex) {
  const Vec3d far{4.5e8, 7.25e9, -3e6};
  const TriangleMesh mesh = box_mesh(far, far + Vec3d{1000, 2000.5, 3000});
  const auto placed = snap_to_grid(mesh, {});
  ASSERT_TRUE(placed.has_value());
  Box3l box = empty_box<std::int64_t>();
  for (const Vec3i& v : placed->mesh.vertices) box.include(v.as<std::int64_t>() + placed->base);
  EXPECT_EQ(box.lo, (Vec3l{450000000000, 7250000000000, -3000000000}));
  EXPECT_EQ(box.hi, (Vec3l{450001000000, 7250002000500, -2997000000}));
}

TEST(Place, TheLocalOriginDoesNotShow) {
  const auto placed = snap_to_grid(box_mesh({0, 0, 0}, {10000, 1, 3}), {});
  const auto other = snap_to_grid(box_mesh({-700, 20, 0.5}, {9300, 21, 3.5}), {});
  ASSERT_TRUE(placed.has_value() && other.has_value());
  EXPECT_EQ(placed->base, (Vec3l{5000000, 500, 1500}));
  EXPECT_EQ(other->base, (Vec3l{4300000, 20500, 2000}));
  EXPECT_EQ(placed->mesh.vertices, other->mesh.vertices);
}

TEST(Place, TooWideIsRefused) {
  EXPECT_FALSE(snap_to_grid(box_mesh({0, 0, 0}, {2200000, 1, 1}), {}).has_value());
  EXPECT_TRUE(snap_to_grid(box_mesh({0, 0, 0}, {2100000, 1, 1}), {}).has_value());
}

TEST(Place, StretchIsExactForSimilarities) {
  Mat3d turned;
  turned.row = {Vec3d{0.6 * 7, -0.8 * 7, 0}, Vec3d{0.8 * 7, 0.6 * 7, 0}, Vec3d{0, 0, 7}};
  EXPECT_NEAR(largest_scale(turned), 7, 1e-10);
}

// Any permutation of vertices and triangles, any starting vertex: the same bytes.
TEST(MeshRepair, OrderOfTheSourceDoesNotMatter) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    TriangleMesh mesh;
    const auto pick = [&] { return static_cast<double>(random() % 4); };
    for (int b = 0; b < 4; ++b) {
      const Vec3d lo{pick(), pick(), pick()};
      add_box(mesh, lo, lo + Vec3d{pick() + 1, pick() + 1, pick()}, random() % 2 == 0);
    }
    TriangleMesh shuffled;
    std::vector<std::uint32_t> order(mesh.vertices.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::shuffle(order.begin(), order.end(), random);
    shuffled.vertices.resize(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) shuffled.vertices[order[i]] = mesh.vertices[i];
    for (const Triangle& t : mesh.triangles) {
      const std::size_t k = random() % 3;
      shuffled.triangles.push_back({order[t[k]], order[t[(k + 1) % 3]], order[t[(k + 2) % 3]]});
    }
    std::shuffle(shuffled.triangles.begin(), shuffled.triangles.end(), random);
    const RepairedMesh a = analysed(mesh), b = analysed(shuffled);
    ASSERT_EQ(a.parts.size(), b.parts.size());
    for (std::size_t i = 0; i < a.parts.size(); ++i) EXPECT_TRUE(same(a.parts[i], b.parts[i]));
  }
}

TEST(MeshRepair, MemoryOfEarlierMeshesLeavesNoTrace) {
  std::vector<TriangleMesh> meshes;
  TriangleMesh many = box_mesh({0, 0, 0}, {9, 9, 9});
  for (int i = 0; i < 60; ++i) add_box(many, {20.0 * i, 0, 0}, {20.0 * i + 5, 5, 5}, i % 7 == 0);
  meshes.push_back(many);                                  // many shells, one crossed
  meshes.push_back(box_mesh({0, 0, 0}, {1, 2, 3}, true));  // small after large, inside out
  TriangleMesh faced = box_mesh({0, 0, 0}, {1, 1, 1});
  for (std::uint32_t t = 0; t < faced.triangles.size(); ++t) faced.faces.push_back(t / 2);
  meshes.push_back(faced);                                                // faces, then none again
  meshes.push_back(box_mesh({0, 0, 0}, {1, 1, 0}));                       // flat
  meshes.emplace_back();                                                  // nothing at all
  meshes.push_back(box_mesh({-2e6, -2e6, -2e6}, {1.2e5, 1.2e5, 1.2e5}));  // keys of two words
  TriangleMesh open = box_mesh({0, 0, 0}, {2, 2, 2});
  open.triangles.pop_back();
  open.vertices.push_back({5e9, 0, 0});  // used by no triangle
  meshes.push_back(open);
  GridSnapper placer;
  MeshRepairer analyser;
  for (int round = 0; round < 2; ++round)
    for (const TriangleMesh& mesh : meshes) {
      const SnappedMesh* placed = placer.snap_to_grid(mesh, {});
      ASSERT_NE(placed, nullptr);
      const RepairedMesh reused = analyser.repair_mesh(placed->mesh), fresh = analysed(mesh);
      ASSERT_EQ(reused.parts.size(), fresh.parts.size());
      for (std::size_t p = 0; p < fresh.parts.size(); ++p) {
        EXPECT_TRUE(same(reused.parts[p], fresh.parts[p]));
        EXPECT_EQ(reused.parts[p].faces, fresh.parts[p].faces);
      }
    }
}

TEST(MeshRepair, VerticesAreInOrderHoweverWideTheMesh) {
  // A word holds the first box's vertices as keys, not the second's.
  for (const double size : {1.0, 2.1e6}) {
    const RepairedMesh a = analysed(box_mesh({0, 0, 0}, {size, size, size}));
    ASSERT_EQ(a.parts.size(), 1U);
    EXPECT_TRUE(std::is_sorted(a.parts[0].vertices.begin(), a.parts[0].vertices.end()));
    const double side = size * 1000;
    EXPECT_DOUBLE_EQ(a.parts[0].volume, side * side * side);
  }
}

}  // namespace
}  // namespace strake::geometry
