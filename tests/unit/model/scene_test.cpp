// SPDX-License-Identifier: Apache-2.0
#include "strake/model/scene.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "support/grid_bodies.hpp"
#include "support/meshes.hpp"

namespace strake::model {
namespace {

using geometry::Mat3d;
using geometry::Placement;
using geometry::Vec3d;

/// A model of one file; every shape added becomes an object with one body.
struct Builder {
  Model model;
  Builder() { model.files.push_back({"t.obj", "OBJ", "mm", "z", 1, 0}); }
  ShapeId shape(Shape s) {
    model.shapes.push_back(std::move(s));
    return ShapeId{static_cast<std::uint32_t>(model.shapes.size() - 1)};
  }
  Body& object(ShapeId shape, const Placement& placement = {}) {
    Object o;
    o.id = std::to_string(model.objects.size());
    o.first_body = static_cast<std::uint32_t>(model.bodies.size());
    o.body_count = 1;
    model.objects.push_back(o);
    Body b;
    b.shape = shape;
    b.placement = placement;
    model.bodies.push_back(b);
    return model.bodies.back();
  }
  [[nodiscard]] Scene scene(const SceneOptions& options = {}) const {
    return make_scene(model, options, {}).value();
  }
};

TEST(Scene, InstancesShareAGridShape) {
  Builder b;
  const ShapeId box = b.shape(test::box_mesh({0, 0, 0}, {1, 1, 1}));
  for (int i = 0; i < 10; ++i) b.object(box, {{}, {i * 2.0, 0, 0.0004}});
  Mat3d turned;
  turned.row = {Vec3d{0, -1, 0}, Vec3d{1, 0, 0}, Vec3d{-0.0, 0, 1}};
  b.object(box, {turned, {}});
  turned.row[2].x = 0.0;
  b.object(box, {turned, {}});
  const Scene s = b.scene();
  EXPECT_EQ(s.shapes.size(), 2U);
  ASSERT_EQ(s.bodies.size(), 12U);
  EXPECT_EQ(s.bodies[3].origin, (geometry::Vec3l{6500, 500, 500}));
  EXPECT_EQ(s.bodies_of(ObjectId{11}).size(), 1U);
  EXPECT_EQ(s.bodies[11].grid_shape, 1U);
}

/// Corners of a body in the model, in the order of its parts.
std::vector<geometry::Vec3l> corners_of(const Scene& s, std::size_t body) {
  std::vector<geometry::Vec3l> corners;
  for (const geometry::Part& part : s.shapes[s.bodies[body].grid_shape].parts)
    for (const geometry::Vec3i& v : part.vertices)
      corners.push_back(v.as<std::int64_t>() + s.bodies[body].origin);
  return corners;
}

TEST(Scene, MeshesThatAreEachOtherMovedShareAGridShape) {
  const std::vector<Vec3d> places = {{0, 0, 0}, {12.345, -7, 0.001}, {4e9, 0, -3e9}, {-1, 2, 3}};
  const auto mesh_at = [](const Vec3d& at) {
    geometry::TriangleMesh mesh = test::box_mesh(at, at + Vec3d{1, 2, 3});
    test::add_box(mesh, at + Vec3d{5, 0, 0}, at + Vec3d{6, 1, 1});
    return mesh;
  };
  Builder all;
  for (const Vec3d& at : places) all.object(all.shape(mesh_at(at)), {{}, {0.5, 0, 100}});
  const Scene s = all.scene();
  EXPECT_EQ(s.shapes.size(), 1U);
  ASSERT_EQ(s.bodies.size(), places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    Builder alone;
    alone.object(alone.shape(mesh_at(places[i])), {{}, {0.5, 0, 100}});
    EXPECT_EQ(corners_of(s, i), corners_of(alone.scene(), 0)) << i;
  }
}

TEST(Scene, MeshesThatDifferInAnythingDoNotShare) {
  const geometry::TriangleMesh mesh = test::box_mesh({0, 0, 0}, {1, 1, 1});
  std::vector<geometry::TriangleMesh> all(6, mesh);
  all[1].sag_mm = 0.25;
  all[2].vertices[0].x -= 0.001;
  all[3].triangles.pop_back();
  all[4] = test::box_mesh({0, 0, 0}, {1, 1, 1}, true);
  test::add_box(all[5], {5, 5, 5}, {6, 6, 6});
  Builder b;
  for (const geometry::TriangleMesh& one : all) b.object(b.shape(one));
  // What a mesh equals may stand for more than it: a primitive has curves, and a fault its text.
  b.object(b.shape(geometry::Primitive{geometry::BoxPrimitive{1, 1, 1}}));
  b.object(b.shape(geometry::Primitive{geometry::BoxPrimitive{1, 1, 1}}));
  b.object(b.shape(geometry::TriangleMesh{}));
  b.object(b.shape(geometry::TriangleMesh{}));
  const Scene s = b.scene();
  EXPECT_EQ(s.shapes.size(), 10U);
  EXPECT_EQ(s.diagnostics.count(kVanished), 2U);
  EXPECT_EQ(s.diagnostics.count("mesh-inverted"), 1U);
  for (std::uint32_t i = 0; i < s.bodies.size(); ++i) EXPECT_EQ(s.bodies[i].grid_shape, i);
}

TEST(Scene, WhatIsReportedOfAShapeIsReportedOfAllItsBodies) {
  geometry::TriangleMesh turned = test::box_mesh({0, 0, 0}, {1, 1, 1});
  for (geometry::Triangle& t : turned.triangles) std::swap(t[1], t[2]);
  const auto reported = [&](int bodies) {
    Builder b;
    const ShapeId box = b.shape(turned);
    for (int i = 0; i < bodies; ++i) b.object(box, {{}, {i * 5.0, 0, 0}});
    const Scene s = b.scene();
    EXPECT_EQ(s.diagnostics.count("mesh-inverted"), 1U);
    for (const Diagnostic& d : s.diagnostics.kept())
      if (d.code == "mesh-inverted") return d.message;
    return std::string();
  };
  EXPECT_EQ(reported(1), "a solid had its faces pointing inwards; they were flipped");
  EXPECT_EQ(reported(2),
            "a solid had its faces pointing inwards; they were flipped; likewise in 1 more body of "
            "the same shape");
  EXPECT_EQ(reported(4),
            "a solid had its faces pointing inwards; they were flipped; likewise in 3 more bodies "
            "of the same shape");
}

TEST(Scene, BoxPrimitiveIsASolidWithItsSourceAndNoSag) {
  Builder b;
  b.object(b.shape(geometry::Primitive{geometry::BoxPrimitive{2, 4, 6}}), {{}, {10, 0, 0}});
  const Scene s = b.scene();
  ASSERT_EQ(s.shapes.at(0).parts.size(), 1U);
  const geometry::Part& p = s.shapes[0].parts[0];
  EXPECT_EQ(p.kind, geometry::PartKind::solid);
  EXPECT_TRUE(p.primitive.has_value());
  EXPECT_EQ(p.sag, 0);
  EXPECT_FALSE(p.flags.unknown_sag || p.flags.inverted);
  EXPECT_DOUBLE_EQ(p.volume, 48e9);
  EXPECT_EQ(s.bodies[0].box(s.shapes[0]).hi, (geometry::Vec3l{11000, 2000, 3000}));
}

TEST(Scene, MeshSagIsScaledOrFlagged) {
  Builder b;
  geometry::TriangleMesh mesh = test::box_mesh({0, 0, 0}, {1, 1, 1});
  const ShapeId unknown = b.shape(mesh);
  mesh.sag_mm = 0.25;
  const ShapeId known = b.shape(mesh);
  Mat3d twice;
  for (std::size_t i = 0; i < 3; ++i) twice.row[i][static_cast<int>(i)] = 2;
  b.object(unknown);
  b.object(known, {twice, {}});
  const Scene s = b.scene();
  EXPECT_TRUE(s.shapes[0].parts[0].flags.unknown_sag);
  EXPECT_NEAR(s.shapes[1].parts[0].sag, 500, 1e-6);
}

TEST(Scene, CategoriesAreSelected) {
  Builder b;
  const ShapeId box = b.shape(test::box_mesh({0, 0, 0}, {1, 1, 1}));
  b.object(box);
  b.object(box).category = Category::obstruction;
  b.object(box).category = Category::insulation;
  EXPECT_EQ(b.scene().bodies.size(), 1U);
  EXPECT_EQ(b.scene().left_out, 2U);
  SceneOptions all;
  all.obstruction = all.insulation = true;
  EXPECT_EQ(b.scene(all).bodies.size(), 3U);
}

TEST(Scene, WhatCannotBePlacedIsSkippedByName) {
  Builder b;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const ShapeId box = b.shape(test::box_mesh({0, 0, 0}, {1, 1, 1}));
  b.object(box);
  b.object(box, {{}, {nan, 0, 0}});
  Mat3d bad;
  bad.row[1].y = nan;
  b.object(box, {bad, {}});
  b.object(b.shape(test::box_mesh({0, 0, 0}, {3e6, 1, 1})));
  b.object(b.shape(geometry::TriangleMesh{}));
  b.object(ShapeId{99});
  const Scene s = b.scene();
  EXPECT_EQ(s.bodies.size(), 1U);
  EXPECT_EQ(s.diagnostics.count("body-unplaceable"), 1U);
  EXPECT_EQ(s.diagnostics.count("shape-unplaceable"), 2U);
  EXPECT_EQ(s.diagnostics.count("shape-vanished"), 1U);
  EXPECT_EQ(s.diagnostics.count("body-without-shape"), 1U);
  ASSERT_FALSE(s.diagnostics.kept().empty());
  EXPECT_EQ(s.diagnostics.kept().back().where, "t.obj: 4");
  EXPECT_EQ(s.first_body.back(), 1U);
  std::vector<std::pair<std::uint32_t, std::string_view>> lacking;
  for (const IncompleteObject& l : s.lacking) lacking.emplace_back(index(l.object), l.code);
  EXPECT_EQ(lacking, (decltype(lacking){{1, "body-unplaceable"},
                                        {2, "mesh-bad-triangle"},
                                        {2, "shape-unplaceable"},
                                        {3, "shape-unplaceable"},
                                        {4, "shape-vanished"},
                                        {5, "body-without-shape"}}));
}

TEST(Scene, PolylinesBecomeWires) {
  Builder b;
  geometry::Polylines lines;
  lines.points = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0.0001}, {1, 1, 0}, {5, 5, 5}, {0, 0, 1}, {0, 0, 2}};
  lines.first = {0, 4, 5, 7};
  b.object(b.shape(lines));
  const Scene s = b.scene();
  const geometry::Part& p = s.shapes.at(0).parts.at(0);
  EXPECT_EQ(p.kind, geometry::PartKind::wire);
  EXPECT_EQ(p.vertices.size(), 5U);
  EXPECT_EQ(p.chain_first, (std::vector<std::uint32_t>{0, 3, 5}));
}

TEST(Scene, InvertedSolidsAreReported) {
  Builder b;
  b.object(b.shape(test::box_mesh({0, 0, 0}, {1, 1, 1}, true)));
  EXPECT_EQ(b.scene().diagnostics.count("mesh-inverted"), 1U);
}

TEST(Scene, SurfacesThatDoNotCloseAreDistinguishedFromThoseThatFaceBothWays) {
  geometry::TriangleMesh turned = test::box_mesh({0, 0, 0}, {1, 1, 1}), open = turned;
  std::swap(turned.triangles[3][0], turned.triangles[3][1]);
  open.triangles.pop_back();
  geometry::TriangleMesh mixed;
  for (const geometry::Vec3i& v : test::one_sided_mesh().vertices)
    mixed.vertices.push_back(v.as<double>());
  mixed.triangles = test::one_sided_mesh().triangles;
  Builder b;
  b.object(b.shape(turned));
  EXPECT_EQ(b.scene().diagnostics.count("mesh-turned"), 1U);
  EXPECT_EQ(b.scene().diagnostics.count("mesh-mixed-winding"), 0U);
  b.object(b.shape(mixed));
  EXPECT_EQ(b.scene().diagnostics.count("mesh-mixed-winding"), 1U);
  EXPECT_EQ(b.scene().diagnostics.count("mesh-open"), 0U);
  b.object(b.shape(open));
  EXPECT_EQ(b.scene().diagnostics.count("mesh-mixed-winding"), 1U);
  EXPECT_EQ(b.scene().diagnostics.count("mesh-open"), 1U);
}

TEST(Scene, SkinsDrawnFromBothSidesAreReported) {
  Builder b;
  geometry::TriangleMesh mesh = test::box_mesh({0, 0, 0}, {1, 1, 1});
  test::add_box(mesh, {0, 0, 0}, {1, 1, 1}, true);
  b.object(b.shape(mesh));
  const Scene scene = b.scene();
  EXPECT_EQ(scene.diagnostics.count("mesh-two-sided"), 1U);
  EXPECT_EQ(scene.diagnostics.count("mesh-inverted"), 0U);
}

TEST(Scene, ASagThatIsNoLengthIsAnError) {
  const Builder b;
  SceneOptions options;
  options.sag_mm = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(make_scene(b.model, options, {}).has_value());
  options.sag_mm = 0;
  EXPECT_FALSE(make_scene(b.model, options, {}).has_value());
}

}  // namespace
}  // namespace strake::model
