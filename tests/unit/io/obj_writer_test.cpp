// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "io/source/input_file.hpp"
#include "strake/io/writer.hpp"
#include "support/io_files.hpp"
#include "support/io_models.hpp"

namespace strake::io {
namespace {

using geometry::Vec3d;

TEST(ObjWriter, IsReadBackExactly) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "x.obj";
  const model::Model sample = test::sample_model();
  ASSERT_TRUE(write_obj(sample, path, {}, {}));
  const Result<FileContent> content = FileContent::read(path);
  ASSERT_TRUE(content);
  const Result<model::Model> back = make_obj_reader()->read({path, content->bytes()}, {}, {});
  ASSERT_TRUE(back);
  ASSERT_EQ(back->objects.size(), sample.objects.size());
  for (std::size_t i = 0; i < sample.objects.size(); ++i)
    EXPECT_EQ(back->objects[i].id, sample.objects[i].id);
  const auto& first = std::get<geometry::TriangleMesh>(back->shapes[0]);
  const auto& box = std::get<geometry::TriangleMesh>(sample.shapes[0]);
  EXPECT_EQ(first.triangles, box.triangles);
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_EQ(first.vertices[i], box.vertices[i] + (Vec3d{10, 20, 30}));
  const auto& pair = std::get<geometry::TriangleMesh>(back->shapes[2]);
  EXPECT_EQ(pair.vertices.size(), 16U) << "both bodies in world coordinates";
  EXPECT_EQ(pair.vertices[7], (Vec3d{-500, 8000, 250}));
  EXPECT_EQ(pair.vertices[15], (Vec3d{1000, 7500, 1250}));
  const auto& axis = std::get<geometry::Polylines>(back->shapes.back());
  EXPECT_EQ(axis.first, (std::vector<std::uint32_t>{0, 3, 5}));
  EXPECT_EQ(axis.points[4], (Vec3d{9, 10, 12}));
}

TEST(ObjWriter, KeepsMirroredSolidsOutside) {
  model::Model model;
  const model::ShapeId box = test::add_shape(model, test::box_mesh(1, 2, 3));
  test::add_object(model, "mirrored", "mirrored");
  test::add_body(model, box, {{{{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}}, {0, 0, 0}});
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_obj(model, folder.path() / "x.obj", {}, {}));
  const Result<FileContent> content = FileContent::read(folder.path() / "x.obj");
  ASSERT_TRUE(content);
  const Result<model::Model> back = make_obj_reader()->read({"x.obj", content->bytes()}, {}, {});
  ASSERT_TRUE(back);
  const auto& mesh = std::get<geometry::TriangleMesh>(back->shapes[0]);
  double volume = 0;
  for (const auto& t : mesh.triangles)
    volume += dot(mesh.vertices[t[0]], cross(mesh.vertices[t[1]], mesh.vertices[t[2]])) / 6;
  EXPECT_DOUBLE_EQ(volume, 6);
}

}  // namespace
}  // namespace strake::io
