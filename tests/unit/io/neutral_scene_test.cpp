// SPDX-License-Identifier: Apache-2.0
// Neutral scenes: a model that is written and read again is what it was, to the last bit.
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "strake/io/reader.hpp"
#include "strake/io/writer.hpp"
#include "support/equal_models.hpp"
#include "support/io_files.hpp"
#include "support/io_models.hpp"
#include "support/io_seeds.hpp"
#include "support/random_primitives.hpp"

namespace strake::io {
namespace {

using model::Model;

WriteOptions keeping_all() {
  WriteOptions options;
  options.keep_all = true;
  return options;
}

Model written_and_read(const Model& model, const ReadOptions& options = {}) {
  const test::TemporaryFolder folder;
  const std::vector<std::filesystem::path> files{folder.path() / "x.glb"};
  const Status written = write_glb(model, files[0], keeping_all(), {});
  EXPECT_TRUE(written) << (written ? "" : written.error().text());
  Result<Model> read = read_models(files, options, {});
  EXPECT_TRUE(read) << (read ? "" : read.error().text());
  return read ? std::move(*read) : Model{};
}

/// What two models differ in besides the facts about their files, and what was noticed of them.
std::string difference(Model a, const Model& b) {
  a.files = b.files;
  a.diagnostics = b.diagnostics;
  return test::model_difference(a, b);
}

Model finished(Model model) {
  finish(model);
  return model;
}

/// Bodies of every kind of primitive and placement, of all categories and of odd precisions, and
/// meshes whose doubles and polygons float32 triangles have no place for.
Model random_model(std::uint64_t seed) {
  test::PrimitiveDraw draw(seed);
  Model model;
  model.files.push_back({"random", "made", "mm (stated)", "z", 0, 0});
  std::vector<model::GroupId> groups{test::add_group(model, "")};
  model.set_attributes(groups[0], {{"k", "v"}, {"k", "w"}, {"Pset_WallCommon.FireRating", "F60"}});
  for (int i = 0; i < 40; ++i) {
    test::add_object(model, "id " + std::to_string(i), i % 3 == 0 ? "" : "n\"Ä", groups[0])
        .attributes = {{"long", std::string(static_cast<std::size_t>(i) * 200, 'x')}, {"", ""}};
    model::Object& object = model.objects.back();
    object.positional_id = i % 5 == 0;
    const std::uint64_t bodies = draw.below(4);
    object.incomplete = i % 7 == 0 || bodies == 0;
    for (std::uint64_t b = 0; b < bodies; ++b) {
      geometry::Primitive primitive =
          draw.convex(draw.below(test::PrimitiveDraw::kConvexKinds), 90);
      model::ShapeId shape{};
      if (i % 4 == 1) {
        geometry::TriangleMesh mesh = test::box_mesh(draw.between(1, 9), 0.1, 1.0 / 3);
        mesh.faces.assign(mesh.triangles.size(), 3);
        mesh.faces[5] = geometry::kNoIndex;
        mesh.sag_mm = draw.between(0, 1);
        shape = test::add_shape(model, mesh);
      } else if (i % 4 == 2 && !model.shapes.empty()) {
        shape = static_cast<model::ShapeId>(draw.below(model.shapes.size()));
      } else {
        shape = test::add_shape(model, primitive);
      }
      test::add_body(model, shape, {draw.linear(), draw.point(1e6)},
                     {static_cast<std::uint8_t>(b), 2, 3, static_cast<std::uint8_t>(250 + b)});
      model.bodies.back().precision_um = static_cast<float>(draw.between(0, 1));
      model.bodies.back().category = static_cast<model::Category>(b % 3);
    }
  }
  return finished(std::move(model));
}

/// Its objects are not in the order of its groups, and come back in that order.
TEST(NeutralScene, ASampleComesBack) {
  Model model = finished(test::sample_model());
  const Model read = written_and_read(model);
  ASSERT_EQ(read.objects.size(), model.objects.size());
  for (std::size_t i = 0; i < model.objects.size(); ++i)
    model.objects[i].place = read.objects[i].place;
  EXPECT_EQ(difference(read, model), "");
}

/// Shapes are numbered as bodies come to them.
TEST(NeutralScene, AnyModelComesBackToTheLastBit) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Model model = random_model(seed);
    Model read = written_and_read(model);
    ASSERT_EQ(read.bodies.size(), model.bodies.size());
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      const auto shape = [b](const Model& of) { return of.shapes[index(of.bodies[b].shape)]; };
      ASSERT_TRUE(test::same_shape(shape(read), shape(model))) << seed << ", body " << b;
      read.bodies[b].shape = model.bodies[b].shape;
    }
    read.shapes = model.shapes;
    ASSERT_EQ(difference(read, model), "") << seed;
    // What comes back as it was is written as it was.
    const Model again = written_and_read(written_and_read(model));
    ASSERT_EQ(difference(again, written_and_read(model)), "") << seed;
  }
}

std::string bytes_written(const Model& model) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(write_glb(model, folder.path() / "x.glb", keeping_all(), {}));
  std::ifstream file(folder.path() / "x.glb", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Groups of several files in any order, with and without objects: what was read is written with
/// the same bytes, however often.
TEST(NeutralScene, WhatWasReadIsWrittenWithTheSameBytes) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    test::PrimitiveDraw draw(seed);
    Model model;
    const std::uint64_t files = 1 + draw.below(3);
    for (std::uint64_t f = 0; f < files; ++f)
      model.files.push_back({"file " + std::to_string(f), "made", "mm (stated)", "z", 0, 0});
    std::vector<model::GroupId> groups{model::GroupId::none};
    for (int g = 0; g < 12; ++g)
      groups.push_back(
          test::add_group(model, "g" + std::to_string(g), groups[draw.below(groups.size())]));
    const model::ShapeId shape = test::add_shape(model, geometry::SpherePrimitive{5});
    for (int i = 0; i < 20; ++i) {
      test::add_object(model, "id " + std::to_string(draw.below(30)), "n",
                       groups[draw.below(groups.size())]);
      model.objects.back().file = static_cast<std::uint32_t>(draw.below(files));
      test::add_body(model, shape, {draw.linear(), draw.point(1e6)});
    }
    const Model once = written_and_read(finished(std::move(model)));
    const std::string second = bytes_written(once);
    const Model twice = written_and_read(once);
    EXPECT_EQ(bytes_written(twice), second) << seed;
  }
}

/// Equal shapes of different colours, and a primitive at different scales, are one shape.
TEST(NeutralScene, SharedShapesStayShared) {
  Model model;
  model.files.push_back({"shared", "made", "mm (stated)", "z", 0, 0});
  const model::ShapeId pipe = test::add_shape(model, geometry::CylinderPrimitive{50, 1000});
  for (int i = 0; i < 3; ++i) {
    test::add_object(model, "pipe " + std::to_string(i), "pipe");
    geometry::Placement placement;
    for (int k = 0; k < 3; ++k) placement.linear.row[static_cast<std::size_t>(k)][k] = 1 + 2.5 * i;
    test::add_body(model, pipe, placement, {static_cast<std::uint8_t>(i), 0, 0, 255});
  }
  model = finished(std::move(model));
  EXPECT_EQ(difference(written_and_read(model), model), "");
}

TEST(NeutralScene, WhatHasNoExtentIsKept) {
  Model model;
  model.files.push_back({"flat", "made", "mm (stated)", "z", 0, 0});
  test::add_object(model, "none", "none");
  test::add_body(model, test::add_shape(model, geometry::SpherePrimitive{0}), {});
  test::add_object(model, "one", "one");
  test::add_body(model, test::add_shape(model, geometry::LinePrimitive{1, 20}), {});
  model = finished(std::move(model));
  EXPECT_EQ(difference(written_and_read(model), model), "");
}

/// Other readers of glTF are shown metres with y up.
TEST(NeutralScene, AnotherReaderSeesMetres) {
  const test::TemporaryFolder folder;
  const Model model = finished(test::sample_model());
  ASSERT_TRUE(write_glb(model, folder.path() / "x.glb", keeping_all(), {}));
  std::ifstream file(folder.path() / "x.glb", std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  // Of an asset that says nothing to us, the same length.
  const std::string ours = R"("strake":{"scene":1})";
  const std::size_t at = bytes.find(ours);
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, ours.size(), R"("others":{"scene":1})");
  const Result<Model> read = test::read_bytes(*make_gltf_reader(), bytes, "x.glb");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->files[0].unit, "m (stated)");
  ASSERT_EQ(read->objects.size(), 6U) << "the bodies of one are two";
  const geometry::Placement& placed = read->bodies[read->objects[0].first_body].placement;
  const geometry::Vec3d corner = placed * geometry::Vec3d{};
  EXPECT_NEAR(corner.x, 10, 1e-6);
  EXPECT_NEAR(corner.y, 20, 1e-6);
  EXPECT_NEAR(corner.z, 30, 1e-6);
}

TEST(NeutralScene, AnotherUnitMovesAndScalesAll) {
  const Model model = finished(test::sample_model());
  ReadOptions inches;
  inches.unit_mm = 25.4;
  const Model read = written_and_read(model, inches);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const geometry::Vec3d p{1, 2, 3};
    const geometry::Vec3d far = model.bodies[b].placement * p * 25.4;
    const geometry::Vec3d moved = read.bodies[b].placement * p - far;
    EXPECT_LT(dot(moved, moved), 1e-12);
  }
}

TEST(NeutralScene, FilesBecomeGroupsAndIdsStayApart) {
  Model model = test::sample_model();
  Model other = test::sample_model();
  other.files[0].label = "other";
  other.objects[1].id = "alone";
  append(model, std::move(other));
  model = finished(std::move(model));
  const Model read = written_and_read(model);
  ASSERT_EQ(read.objects.size(), 10U);
  EXPECT_EQ(read.diagnostics.count("object-id-repeated"), 0U);
  std::vector<std::string> ids;
  for (const model::Object& object : read.objects) {
    ids.push_back(object.id);
    if (object.id == "alone") {
      EXPECT_EQ(read.path(object), "other/Deck \"A\"/Frame 7/8");
    }
  }
  EXPECT_EQ(ids, (std::vector<std::string>{"alone", "other:five", "other:four", "other:one",
                                           "other:three", "sample:five", "sample:four",
                                           "sample:one", "sample:three", "two"}));
}

TEST(NeutralScene, WhatWasNoticedIsKept) {
  Model model = test::sample_model();
  for (int i = 0; i < 130; ++i)
    model.diagnostics.add(Severity::skipped, "odd", "an odd \"one\"", "x.rvm, byte 7");
  model.files[0].ends_early = true;
  const Model read = written_and_read(finished(std::move(model)));
  EXPECT_EQ(read.diagnostics.skipped(), 130U);
  ASSERT_EQ(read.diagnostics.kept().size(), Diagnostics::kMaxPerCode);
  EXPECT_EQ(read.diagnostics.kept()[0].message, "an odd \"one\"");
  EXPECT_TRUE(read.files[0].ends_early);
}

/// Each colour of a shape is a mesh, and all name the same bytes.
TEST(NeutralScene, AShapeInManyColoursComesBack) {
  constexpr std::uint32_t kSide = 100;
  geometry::TriangleMesh sheet;
  for (std::uint32_t y = 0; y <= kSide; ++y)
    for (std::uint32_t x = 0; x <= kSide; ++x)
      sheet.vertices.push_back({static_cast<double>(x), static_cast<double>(y), 0});
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const std::uint32_t a = y * (kSide + 1) + x, b = a + kSide + 1;
      sheet.triangles.push_back({a, a + 1, b});
      sheet.triangles.push_back({a + 1, b + 1, b});
    }
  Model model;
  model.files.push_back({"sheets", "made", "mm (stated)", "z", 0, 0});
  const model::ShapeId shape = test::add_shape(model, sheet);
  for (int i = 0; i < 1000; ++i) {
    test::add_object(model, "id " + std::to_string(i), "sheet");
    test::add_body(
        model, shape, {},
        {static_cast<std::uint8_t>(i % 256), static_cast<std::uint8_t>(i / 256), 0, 255});
  }
  const Model written = finished(std::move(model));
  EXPECT_EQ(difference(written_and_read(written), written), "");
}

/// None is long, and all together are more than a reader takes of what others call attributes.
TEST(NeutralScene, ManyAttributesComeBack) {
  Model model = test::sample_model();
  model.objects[0].attributes.clear();  // whose names repeat, which alone would keep them
  for (int i = 0; i < 400; ++i)
    model.objects[0].attributes.emplace_back("name " + std::to_string(i), std::string(300, 'v'));
  model.set_attributes(model::GroupId{}, model.objects[0].attributes);
  const Model written = finished(std::move(model));
  const Model read = written_and_read(written);
  ASSERT_EQ(read.objects.size(), written.objects.size());
  for (std::size_t i = 0; i < written.objects.size(); ++i)
    EXPECT_EQ(read.objects[i].attributes, written.objects[i].attributes);
  EXPECT_EQ(read.group_attributes, written.group_attributes);
}

/// A cylinder below a group, of which something more is said.
std::string cylinder(const std::string& diagnostics, const std::string& of_group) {
  return R"({"asset":{"version":"2.0","extras":{"strake":{"scene":1,"diagnostics":[)" +
         diagnostics +
         R"(]}}},"meshes":[{"extras":{"strake":{"shape":0,"primitive":{"kind":"cylinder",)"
         R"("lengths":[5,20]}}}}],"nodes":[{"children":[1],"extras":{"strake":{"is":"frame"}}},)"
         R"({"name":"g","children":[2])" +
         of_group + R"(},{"name":"a","mesh":0,"extras":{"id":"a","strake":{"is":"object"}}}]})";
}

Result<Model> read_cylinder(const std::string& diagnostics, const std::string& of_group) {
  return test::read_bytes(*make_gltf_reader(), cylinder(diagnostics, of_group), "x.gltf");
}

/// Codes are shown as they are, and each is looked for among all.
TEST(NeutralScene, CodesThatAreNoneAndTooManyAreReportedAsOthers) {
  const auto odd =
      read_cylinder(R"(["skipped","\u001b[31m","text","where"],["note","","",""])", "");
  ASSERT_TRUE(odd) << odd.error().text();
  EXPECT_EQ(odd->diagnostics.count("gltf-other-skipped"), 1U);
  EXPECT_EQ(odd->diagnostics.count("gltf-other-note"), 1U);
  EXPECT_EQ(odd->diagnostics.counts().size(), 2U);
  std::string many = R"(["note","c","",""])";
  for (int i = 0; i < 2000; ++i) many += R"(,["note","c)" + std::to_string(i) + R"(","",""])";
  const auto read = read_cylinder(many, "");
  ASSERT_TRUE(read) << read.error().text();
  EXPECT_LE(read->diagnostics.counts().size(), 501U);
  EXPECT_GT(read->diagnostics.count("gltf-other-note"), 1000U);
}

TEST(NeutralScene, BodiesBelowAPlacementThatIsNoneAreSkipped) {
  EXPECT_TRUE(read_cylinder("", R"(,"translation":[1,2,3])"));
  const auto read = read_cylinder("", R"(,"scale":[1,2])");
  ASSERT_FALSE(read) << "it would stand where it does not belong";
  EXPECT_NE(read.error().text().find("transformation"), std::string::npos);
}

TEST(NeutralScene, DamagedBodiesAreSkippedAndNamed) {
  std::string bytes = test::neutral_glb();
  const std::string good = R"("chains":4)";
  bytes.replace(bytes.find(good), good.size(), R"("chains":3)");
  const Result<Model> read = test::read_bytes(*make_gltf_reader(), bytes, "x.glb");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->diagnostics.skipped(), 1U);
  EXPECT_EQ(read->diagnostics.kept().back().code, "gltf-damaged-object");
  ASSERT_EQ(read->objects.size(), 3U);
  EXPECT_TRUE(read->objects[1].incomplete);
  EXPECT_EQ(read->objects[1].body_count, 1U);
}

TEST(NeutralScene, SeedHasWhatItStates) {
  const Result<Model> read = test::read_bytes(*make_gltf_reader(), test::neutral_glb(), "x.glb");
  ASSERT_TRUE(read);
  ASSERT_EQ(read->bodies.size(), 3U);
  const auto& mesh = std::get<geometry::TriangleMesh>(read->shapes[0]);
  EXPECT_EQ(mesh.vertices[0].x, 0.1);
  EXPECT_EQ(mesh.faces, std::vector<std::uint32_t>{7});
  EXPECT_EQ(read->bodies[2].category, model::Category::insulation);
  EXPECT_EQ(read->group_attributes[0], (model::Attributes{{"k", "v"}, {"k", "w"}}));
}

}  // namespace
}  // namespace strake::io
