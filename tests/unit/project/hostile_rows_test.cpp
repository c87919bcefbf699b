// SPDX-License-Identifier: Apache-2.0
// Projects that somebody made to do harm: each row is what SQLite takes, and what blobs say of
// themselves is true.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "project/codec/blob.hpp"
#include "project/model/blocks.hpp"
#include "project/model/columns.hpp"
#include "project/model/file_rows.hpp"
#include "project/model/shape_block.hpp"
#include "project/model/stored_diagnostics.hpp"
#include "strake/generate/ship.hpp"
#include "strake/io/writer.hpp"
#include "support/equal_models.hpp"
#include "support/io_files.hpp"
#include "support/io_models.hpp"
#include "support/stored_models.hpp"

namespace strake::project {
namespace {

namespace fs = std::filesystem;

FilePlace place_of(const model::Model& model) {
  FilePlace place;
  place.groups = static_cast<std::uint32_t>(model.groups.size());
  place.attributes = static_cast<std::uint32_t>(model.group_attributes.size());
  place.shapes = static_cast<std::uint32_t>(model.shapes.size());
  place.bodies = static_cast<std::uint32_t>(model.bodies.size());
  place.objects = static_cast<std::uint32_t>(model.objects.size());
  return place;
}

model::Model finished_sample() {
  model::Model model = test::sample_model();
  model.set_attributes(model::GroupId{0}, {{"Type", "DECK"}});
  model::finish(model);
  return model;
}

double random_real(std::mt19937_64& random) {
  const double any = std::bit_cast<double>(random());
  return random() % 2 == 0 ? any : static_cast<double>(random() % 1000) / 8;
}

/// Primitives of every kind with lengths of any bits.
std::vector<model::Shape> random_primitives(std::mt19937_64& random) {
  std::vector<model::Shape> shapes;
  const auto add = [&](auto primitive) {
    std::array<double, sizeof primitive / sizeof(double)> lengths;
    for (double& length : lengths) length = random_real(random);
    shapes.emplace_back(
        geometry::Primitive(std::bit_cast<std::decay_t<decltype(primitive)>>(lengths)));
  };
  for (int i = 0; i < 40; ++i) {
    add(geometry::BoxPrimitive());
    add(geometry::PyramidPrimitive());
    add(geometry::CylinderPrimitive());
    add(geometry::SnoutPrimitive());
    add(geometry::SpherePrimitive());
    add(geometry::EllipticalDishPrimitive());
    add(geometry::SphericalDishPrimitive());
    add(geometry::CircularTorusPrimitive());
    add(geometry::RectangularTorusPrimitive());
    add(geometry::LinePrimitive());
  }
  return shapes;
}

TEST(ProjectBlocks, AllBitsOfShapesAndBodiesComeBack) {
  std::mt19937_64 random(11);
  std::vector<model::Shape> shapes = random_primitives(random);
  std::vector<PackedShape> packed;
  for (std::uint32_t k = 0; k < 5; ++k) {
    shapes.insert(shapes.begin() + 7 * k, geometry::TriangleMesh());
    packed.push_back({k / 2 + 1, k * 3});
  }
  const auto blob = pack_shapes(shapes, packed);
  ASSERT_TRUE(blob);
  std::vector<model::Shape> back(shapes.size());
  const auto shared = unpack_shapes(*blob, "shapes", back);
  ASSERT_TRUE(shared) << shared.error().text();
  for (std::size_t i = 0; i < shapes.size(); ++i)
    EXPECT_TRUE(test::same_shape(shapes[i], back[i])) << i;
  ASSERT_EQ(shared->size(), packed.size());
  for (std::size_t k = 0; k < packed.size(); ++k) {
    EXPECT_EQ((*shared)[k].at, 7 * k);
    EXPECT_EQ((*shared)[k].from, packed[k]);
  }

  std::vector<model::Body> bodies(1000);
  for (model::Body& body : bodies) {
    body.shape = model::ShapeId{static_cast<std::uint32_t>(random() % 50)};
    body.precision_um = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    for (geometry::Vec3d& row : body.placement.linear.row)
      if (random() % 3 == 0) row = {random_real(random), random_real(random), -0.0};
    body.placement.translation = {random_real(random), random_real(random), random_real(random)};
    body.color.alpha = static_cast<std::uint8_t>(random());
    body.category = static_cast<model::Category>(random() % 3);
  }
  const auto body_blob = pack_bodies(bodies);
  ASSERT_TRUE(body_blob);
  FilePlace place;
  place.shapes = 50;
  std::vector<model::Body> bodies_back(bodies.size());
  const Status unpacked = unpack_bodies(*body_blob, "bodies", place, bodies_back);
  ASSERT_TRUE(unpacked) << unpacked.error().text();
  for (std::size_t i = 0; i < bodies.size(); ++i)
    EXPECT_TRUE(test::same_body(bodies[i], bodies_back[i])) << i;
}

TEST(ProjectBlocks, WhatIsNotThereIsNotReferredTo) {
  const model::Model model = finished_sample();
  const auto objects = pack_objects(model.objects);
  const auto bodies = pack_bodies(model.bodies);
  const auto groups = pack_groups(model.groups);
  ASSERT_TRUE(objects && bodies && groups);
  std::vector<model::Object> some_objects(model.objects.size());
  std::vector<model::Body> some_bodies(model.bodies.size());
  std::vector<model::Group> some_groups(model.groups.size());
  const auto takes = [&](const FilePlace& place) {
    return std::array<bool, 3>{
        unpack_objects(*objects, "o", place,
                       some_objects = std::vector<model::Object>(model.objects.size()))
            .has_value(),
        unpack_bodies(*bodies, "b", place, some_bodies).has_value(),
        unpack_groups(*groups, "g", place, some_groups).has_value()};
  };
  const FilePlace all = place_of(model);
  EXPECT_EQ(takes(all), (std::array{true, true, true}));
  FilePlace less = all;
  --less.groups;
  EXPECT_EQ(takes(less), (std::array{false, true, true}));
  less = all;
  --less.bodies;
  EXPECT_EQ(takes(less), (std::array{false, true, true}));
  less = all;
  --less.objects;
  EXPECT_EQ(takes(less), (std::array{false, true, true}));
  less = all;
  --less.shapes;
  EXPECT_EQ(takes(less), (std::array{true, false, true}));
  less = all;
  --less.attributes;
  EXPECT_EQ(takes(less), (std::array{true, true, false}));
}

TEST(ProjectBlocks, OtherNumbersOfItemsAreRefused) {
  const model::Model model = finished_sample();
  const FilePlace place = place_of(model);
  for (const std::size_t count : {model.objects.size() - 1, model.objects.size() + 1}) {
    std::vector<model::Object> objects(count);
    EXPECT_FALSE(unpack_objects(*pack_objects(model.objects), "o", place, objects));
  }
  for (const std::size_t count : {model.bodies.size() - 1, model.bodies.size() + 1}) {
    std::vector<model::Body> bodies(count);
    EXPECT_FALSE(unpack_bodies(*pack_bodies(model.bodies), "b", place, bodies));
  }
  for (const std::size_t count : {model.groups.size() - 1, model.groups.size() + 1}) {
    std::vector<model::Group> groups(count);
    EXPECT_FALSE(unpack_groups(*pack_groups(model.groups), "g", place, groups));
  }
  std::vector<model::Attributes> attributes(2);
  EXPECT_FALSE(unpack_attributes(*pack_attributes(model.group_attributes), "a", attributes));
  std::vector<model::Shape> shapes(1);
  EXPECT_FALSE(
      unpack_shapes(*pack_shapes(model.shapes, std::array<PackedShape, 2>{}), "s", shapes));
}

TEST(ProjectBlocks, IdsOutOfOrderAreRefused) {
  model::Model model = finished_sample();
  std::swap(model.objects[0].id, model.objects[1].id);
  std::vector<model::Object> objects(model.objects.size());
  EXPECT_FALSE(unpack_objects(*pack_objects(model.objects), "o", place_of(model), objects));
  model.objects[0].id = model.objects[1].id;
  EXPECT_FALSE(unpack_objects(*pack_objects(model.objects), "o", place_of(model), objects));
}

TEST(ProjectBlocks, ShapesThatNumberWhatTheyLackAreRefused) {
  const auto refuses = [](const model::Shape& shape) {
    EXPECT_FALSE(is_sound(shape));
    const model::Shape* const one = &shape;
    const std::vector<Hash128> hashes{shape_hash(shape)};
    const auto blob = pack_meshes(std::span(&one, 1), hashes);
    ASSERT_TRUE(blob);
    EXPECT_FALSE(unpack_meshes(*blob, hashes, "pack"));
  };
  geometry::TriangleMesh mesh = test::box_mesh(1, 2, 3);
  mesh.triangles[3][1] = 8;
  refuses(mesh);
  mesh = test::box_mesh(1, 2, 3);
  mesh.faces = {1, 2};
  refuses(mesh);
  geometry::Polylines lines;
  lines.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  for (const std::vector<std::uint32_t>& first :
       {std::vector<std::uint32_t>{}, {0}, {1, 3}, {0, 4}, {0, 2, 1, 3}}) {
    lines.first = first;
    refuses(lines);
  }
}

TEST(ProjectBlocks, ALongTextDoesNotStandForMany) {
  const std::string text(kLongestShared + 1, 'x');
  const std::vector<model::Attributes> many(100, {{"note", text}});
  const auto honest = pack_attributes(many);
  ASSERT_TRUE(honest);
  std::vector<model::Attributes> back(many.size());
  ASSERT_TRUE(unpack_attributes(*honest, "a", back));
  EXPECT_EQ(back, many);
  BlobWriter hostile;
  TextColumn dictionary;
  dictionary.add(text);
  dictionary.write(hostile);
  hostile.planes(std::vector<std::uint32_t>(many.size(), 1));
  hostile.planes(std::vector<std::uint32_t>(many.size() * 2, 0));
  EXPECT_FALSE(unpack_attributes(*hostile.finish(), "a", back));
}

TEST(ProjectBlocks, DiagnosticsAndTheirCountsComeBack) {
  Diagnostics diagnostics;
  for (int i = 0; i < 250; ++i) {
    diagnostics.add(Severity::skipped, "many", "message " + std::to_string(i), "where");
    if (i % 50 == 0) diagnostics.add(Severity::note, "few", "", "");
  }
  const auto blob = pack_diagnostics(diagnostics);
  ASSERT_TRUE(blob);
  const auto back = unpack_diagnostics(*blob, "d");
  ASSERT_TRUE(back) << back.error().text();
  EXPECT_EQ(back->count("many"), 250U);
  EXPECT_EQ(back->count("few"), 5U);
  EXPECT_EQ(back->kept().size(), diagnostics.kept().size());
  EXPECT_EQ(back->skipped(), 250U);
}

/// Rows that no version of the program writes, sealed as if one had.
TEST(HostileProject, RowsThatCannotBeAreErrors) {
  const test::TemporaryFolder folder;
  const auto ship = generate::generate_ship({.objects = 150}, {});
  ASSERT_TRUE(ship);
  const fs::path glb = folder.path() / "a.glb", whole = folder.path() / "whole.strake";
  ASSERT_TRUE(io::write_glb(ship->model, glb, {}, {}));
  {
    auto project = Project::create(whole);
    ASSERT_TRUE(project);
    ASSERT_TRUE(test::store(*project, std::array{glb}));
  }
  for (const char* sql :
       {"UPDATE file SET objects = 0",
        "UPDATE file SET objects = -1",
        "UPDATE file SET objects = objects + 1",
        "UPDATE file SET objects = 4294967294",
        "UPDATE file SET bodies = 9223372036854775807",
        "UPDATE file SET bodies = bodies - 1",
        "UPDATE file SET shapes = shapes + 1",
        "UPDATE file SET shapes = 4000000000",
        "UPDATE file SET groups = groups - 1",
        "UPDATE file SET groups = 32768 * 1000",
        "UPDATE file SET group_attributes = group_attributes + 40000",
        "UPDATE file SET content = zeroblob(15)",
        "UPDATE file SET blocks = zeroblob(16)",
        "UPDATE file SET option_up_axis = 'w'",
        "UPDATE file SET id = -1",
        "DELETE FROM file_block WHERE kind = 'bodies'",
        "DELETE FROM file_block",
        "UPDATE file_block SET number = 1 WHERE kind = 'objects'",
        "UPDATE file_block SET data = zeroblob(1000) WHERE kind = 'objects'",
        "UPDATE file_block SET data = (SELECT data FROM file_block WHERE kind = 'bodies') "
        "WHERE kind = 'objects'",
        "INSERT INTO file_block (file, kind, number, data) SELECT file, kind, 1, data FROM "
        "file_block WHERE kind = 'objects'",
        "DELETE FROM shape_pack",
        "UPDATE shape_pack SET id = id + 1",
        "UPDATE shape_pack SET id = -id",
        "UPDATE shape_pack SET id = id + 4294967296",
        "UPDATE shape_pack SET hashes = zeroblob(15)",
        "UPDATE shape_pack SET hashes = zeroblob(16)",
        "UPDATE shape_pack SET hashes = zeroblob(length(hashes))",
        "UPDATE shape_pack SET hashes = CAST(substr(hashes, 17) || substr(hashes, 1, 16) AS BLOB)",
        "UPDATE shape_pack SET data = zeroblob(50)",
        "INSERT INTO file (position, path, given, name, label, format, unit, up_axis, bytes, "
        "precision_mm, folders, ends_early, content, objects, bodies, shapes, groups, "
        "group_attributes, blocks) VALUES (9, '/x', 'x', 'x', 'x', '', '', '', 0, 0, '', 0, "
        "zeroblob(16), 0, 0, 0, 0, 0, zeroblob(16))"}) {
    SCOPED_TRACE(sql);
    const fs::path file = folder.path() / "hostile.strake";
    fs::copy_file(whole, file, fs::copy_options::overwrite_existing);
    {
      auto project = Project::open(file, {.access = Access::write});
      ASSERT_TRUE(project) << project.error().text();
      ASSERT_TRUE(project->database().execute("PRAGMA foreign_keys = OFF"));
      const Status edited = project->database().execute(sql);
      ASSERT_TRUE(edited) << edited.error().text();
      static_cast<void>(write_labels(project->database()));
    }
    auto project = Project::open(file, {});
    ASSERT_TRUE(project) << project.error().text();
    const auto model = project->model({});
    ASSERT_FALSE(model);
    EXPECT_EQ(model.error().code, ErrorCode::input) << model.error().text();
    EXPECT_NE(model.error().text().find("hostile.strake"), std::string::npos);
  }
}

TEST(HostileProject, ChangesByOthersAreSeen) {
  const test::TemporaryFolder folder;
  const fs::path obj = folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  auto project = Project::create(folder.path() / "p.strake");
  ASSERT_TRUE(project);
  ASSERT_TRUE(test::store(*project, std::array{obj}));
  for (const char* sql : {"UPDATE file SET unit = 'm'", "UPDATE file SET bytes = bytes + 1",
                          "UPDATE file SET given = ''", "DELETE FROM file",
                          "UPDATE model_seal SET files = zeroblob(16)", "DELETE FROM model_seal"}) {
    SCOPED_TRACE(sql);
    auto transaction = Transaction::begin(project->database());
    ASSERT_TRUE(transaction);
    ASSERT_TRUE(project->database().execute(sql));
    EXPECT_FALSE(project->model({}));
    EXPECT_FALSE(project->files());
  }
  EXPECT_TRUE(project->model({}));
}

}  // namespace
}  // namespace strake::project
