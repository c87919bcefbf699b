// SPDX-License-Identifier: Apache-2.0
#include "page/geometry/page_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "geometry/primitives/tessellate.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::page {
namespace {

using geometry::Vec3d;

/// The triangles of page meshes in their own frame.
std::vector<std::array<Vec3d, 3>> triangles_of(const std::vector<PageMesh>& meshes) {
  std::vector<std::array<Vec3d, 3>> triangles;
  for (const PageMesh& mesh : meshes)
    for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
      std::array<Vec3d, 3>& t = triangles.emplace_back();
      for (std::size_t c = 0; c < 3; ++c)
        for (int k = 0; k < 3; ++k)
          t[c][k] = double{mesh.min[static_cast<std::size_t>(k)]} +
                    double{mesh.step} *
                        mesh.position[3U * mesh.index[i + c] + static_cast<std::size_t>(k)];
    }
  return triangles;
}

/// Six times the volume that triangles enclose, placed.
double volume_of(const std::vector<std::array<Vec3d, 3>>& triangles, const geometry::Mat3d& m) {
  double six = 0;
  for (const std::array<Vec3d, 3>& t : triangles) six += dot(m * t[0], cross(m * t[1], m * t[2]));
  return six / 6;
}

geometry::Box3d box_of(const std::vector<std::array<Vec3d, 3>>& triangles,
                       const geometry::Mat3d& m) {
  geometry::Box3d box = geometry::empty_box<double>();
  for (const std::array<Vec3d, 3>& t : triangles)
    for (const Vec3d& corner : t) box.include(m * corner);
  return box;
}

const std::vector<geometry::Primitive>& primitives() {
  static const std::vector<geometry::Primitive> kAll{
      geometry::BoxPrimitive{300, 200, 100},
      geometry::PyramidPrimitive{300, 200, 100, 50, 40, -30, 250},
      geometry::CylinderPrimitive{150, 900},
      geometry::SnoutPrimitive{150, 80, 300, 40, 10, .1, -.05, .2, .1},
      geometry::SpherePrimitive{400},
      geometry::EllipticalDishPrimitive{300, 90},
      geometry::SphericalDishPrimitive{300, 90},
      geometry::CircularTorusPrimitive{400, 100, 1.5},
      geometry::RectangularTorusPrimitive{200, 400, 90, 1.2}};
  return kAll;
}

TEST(PageMesh, UnitsAreTheirPrimitivesOnceScaled) {
  const geometry::Mat3d turned{{Vec3d{0, -1, 0}, Vec3d{1, 0, 0}, Vec3d{0, 0, 1}}};
  const geometry::Mat3d mirrored{{Vec3d{-1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}};
  for (const geometry::Primitive& primitive : primitives())
    for (const geometry::Mat3d& placed : {turned, mirrored}) {
      const UnitPrimitive unit = unit_of(primitive, placed.determinant() < 0);
      const auto shown =
          triangles_of(page_meshes(geometry::tessellate(unit.unit, {}, unit.sag_mm).mesh));
      const geometry::Mat3d matrix = placed * unit.from_unit;
      EXPECT_GT(matrix.determinant(), 0) << kind_name(primitive);
      const geometry::TriangleMesh truth = geometry::tessellate(primitive, placed, .05).mesh;
      const auto fine = triangles_of(page_meshes(truth));
      const double volume = volume_of(fine, {});
      // Circles of a dozen corners lose a tenth of their area.
      EXPECT_NEAR(volume_of(shown, matrix), volume, .13 * volume) << kind_name(primitive);
      const geometry::Box3d box = box_of(shown, matrix), expected = box_of(fine, {});
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(box.lo[k], expected.lo[k], 30) << kind_name(primitive) << k;
        EXPECT_NEAR(box.hi[k], expected.hi[k], 30) << kind_name(primitive) << k;
      }
    }
}

TEST(PageMesh, PositionsAreWithinHalfAStep) {
  geometry::TriangleMesh mesh;
  mesh.vertices = {{1e5, -2e5, 3.25}, {1e5 + 777.7, -2e5, 3.25}, {1e5, -2e5 + 1234.5, 98.75}};
  mesh.triangles = {{0, 1, 2}};
  const std::vector<PageMesh> meshes = page_meshes(mesh);
  ASSERT_EQ(meshes.size(), 1U);
  const auto triangles = triangles_of(meshes);
  for (std::size_t c = 0; c < 3; ++c)
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(triangles[0][c][k], mesh.vertices[c][k], .011) << c << k;
}

TEST(PageMesh, LargeMeshesAreCutAndLoseNothing) {
  geometry::TriangleMesh mesh;
  constexpr std::uint32_t kSide = 300;
  for (std::uint32_t i = 0; i < kSide; ++i)
    for (std::uint32_t j = 0; j < kSide; ++j) mesh.vertices.push_back({double(i), double(j), 0});
  for (std::uint32_t i = 0; i + 1 < kSide; ++i)
    for (std::uint32_t j = 0; j + 1 < kSide; ++j)
      mesh.triangles.push_back({i * kSide + j, (i + 1) * kSide + j, i * kSide + j + 1});
  const std::vector<PageMesh> meshes = page_meshes(mesh);
  EXPECT_GT(meshes.size(), 1U);
  const auto triangles = triangles_of(meshes);
  ASSERT_EQ(triangles.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < triangles.size(); t += 101)
    for (std::size_t c = 0; c < 3; ++c)
      for (int k = 0; k < 2; ++k)
        EXPECT_NEAR(triangles[t][c][k], mesh.vertices[mesh.triangles[t][c]][k], .01);
}

TEST(PageMesh, LinesAreMeshesOfTheirOwn) {
  model::GridShape shape;
  geometry::Part& sheet = shape.parts.emplace_back();
  sheet.vertices = {{0, 0, 0}, {1000000, 0, 0}, {0, 1000000, 0}};
  sheet.triangles = std::vector<geometry::Triangle>{{0, 1, 2}};
  geometry::Part& wire = shape.parts.emplace_back();
  wire.kind = geometry::PartKind::wire;
  wire.vertices = {{0, 0, 0}, {2000000, 0, 0}, {2000000, 3000000, 0}, {0, 0, 5000000}, {0, 0, 0}};
  wire.chain_first = {0, 3, 5};
  const std::vector<PageMesh> meshes = page_meshes(shape);
  ASSERT_EQ(meshes.size(), 2U);
  EXPECT_NE(meshes[0].index[1], meshes[0].index[2]);
  const auto lines = triangles_of({meshes[1]});
  ASSERT_EQ(lines.size(), 3U);
  const std::vector<std::array<std::size_t, 2>> ends{{0, 1}, {1, 2}, {3, 4}};
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_EQ(meshes[1].index[3 * i + 1], meshes[1].index[3 * i + 2]);
    for (std::size_t c = 0; c < 2; ++c)
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(lines[i][c][k], geometry::to_mm(wire.vertices[ends[i][c]].as<double>())[k],
                    .01);
  }
}

TEST(PageMesh, WhatIsEmptyHasNoMesh) {
  EXPECT_TRUE(page_meshes(geometry::TriangleMesh{}).empty());
  EXPECT_TRUE(page_meshes(model::GridShape{}).empty());
}

}  // namespace
}  // namespace strake::page
