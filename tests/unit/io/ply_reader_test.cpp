// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "strake/io/reader.hpp"
#include "support/equal_models.hpp"
#include "support/io_files.hpp"
#include "support/io_seeds.hpp"

namespace strake::io {
namespace {

using geometry::TriangleMesh;
using geometry::Vec3d;

Result<model::Model> read_ply(const std::string& bytes, const ReadOptions& options = {}) {
  return test::read_bytes(*make_ply_reader(), bytes, "some/part.ply", options);
}

std::string text(const std::string& elements, const std::string& numbers) {
  return "ply\r\nformat ascii 1.0\r\n" + elements + "end_header\n" + numbers;
}

const std::string kVertices =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kFaces = "element face 1\nproperty list uchar int vertex_index\n";

TEST(PlyReader, AllEncodingsStateTheSame) {
  std::vector<model::Model> models;
  for (const test::Seed& seed : test::ply_seeds()) {
    Result<model::Model> model = read_ply(seed.bytes);
    ASSERT_TRUE(model) << seed.name << ": " << model.error().text();
    models.push_back(std::move(*model));
  }
  const model::Model& one = models[0];
  ASSERT_EQ(one.objects.size(), 1U);
  EXPECT_EQ(one.objects[0].id, "part");
  ASSERT_EQ(one.objects[0].body_count, 2U);
  const auto& mesh = std::get<TriangleMesh>(one.shapes[0]);
  EXPECT_EQ(mesh.vertices.size(), 4U);
  EXPECT_EQ(mesh.vertices[2], (Vec3d{1, 1, 0.5}));
  EXPECT_EQ(mesh.triangles.size(), 3U);
  EXPECT_EQ(mesh.faces, (std::vector<std::uint32_t>{0, 0, 1}));
  const auto& edge = std::get<geometry::Polylines>(one.shapes[1]);
  EXPECT_EQ(edge.points, (std::vector<Vec3d>{{0, 0, 0.5}, {1, 1, 0.5}}));
  for (const model::Model& other : models)
    for (std::size_t s = 0; s < 2; ++s)
      EXPECT_TRUE(test::same_shape(other.shapes[s], one.shapes[s]));
  EXPECT_EQ(models[0].files[0].format, "PLY text");
  EXPECT_EQ(models[1].files[0].format, "PLY binary");
}

TEST(PlyReader, UnitAndAxisAreObeyedAndPrecisionIsThatOfFloats) {
  const std::string bytes =
      text(kVertices + kFaces, "0 0 0\n1.2345678 0 0\n0 1 0\n0 0 1\n3 0 1 2\n");
  ReadOptions options;
  options.unit_mm = 1000;
  options.up_axis = UpAxis::y;
  const Result<model::Model> model = read_ply(bytes, options);
  ASSERT_TRUE(model);
  EXPECT_EQ(std::get<TriangleMesh>(model->shapes[0]).vertices[2], (Vec3d{0, 0, 1000}));
  EXPECT_GT(model->bodies[0].precision_um, 0);
  EXPECT_EQ(model->files[0].unit, "m (given)");
}

TEST(PlyReader, BadFacesAreLeftOutAndCounted) {
  const std::string faces = "element face 4\nproperty list uchar int vertex_index\n";
  const Result<model::Model> model = read_ply(
      text(kVertices + faces, "0 0 0\n1 0 0\n0 1 0\nnan 0 1\n3 0 1 2\n3 0 1 3\n3 0 1 4\n2 0 1\n"));
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(std::get<TriangleMesh>(model->shapes[0]).triangles.size(), 1U);
  EXPECT_TRUE(model->objects[0].incomplete);
  ASSERT_EQ(model->diagnostics.skipped(), 1U);
  EXPECT_NE(model->diagnostics.kept()[0].message.find("3 faces"), std::string::npos);
}

TEST(PlyReader, OtherElementsArePassedOver) {
  const std::string more =
      "element camera 1\nproperty float view_px\nproperty list uchar float k\n" + kVertices +
      "property uchar red\n" + kFaces +
      "element tristrips 1\nproperty list int int vertex_indices\n";
  const Result<model::Model> model =
      read_ply(text(more, "9 2 1 1\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1\n3 0 1 2\n3 0 1 -1\n"));
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(model->diagnostics.count("ply-element"), 1U);
}

/// Blender wrote so.
TEST(PlyReader, CommentsThatAreNotCalledSo) {
  EXPECT_TRUE(read_ply(text("Created by a program\n" + kVertices + kFaces,
                            "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n")));
  EXPECT_FALSE(read_ply(text(kVertices + "proprty float w\n", "0")));
}

TEST(PlyReader, WhatIsWrongIsStatedAndWhere) {
  const auto refused = [](const std::string& bytes, const std::string& words) {
    const Result<model::Model> model = read_ply(bytes);
    ASSERT_FALSE(model) << words;
    EXPECT_NE(model.error().text().find(words), std::string::npos) << model.error().text();
  };
  refused("ply\nformat ascii 2.0\nend_header\n", "part.ply:2: the version is '2.0'");
  refused("ply\nformat ascii 1.0\nelement vertex x\n", "part.ply:3");
  refused("ply\nformat ascii 1.0\nproperty float x\n", "belongs to no element");
  refused("ply\nformat ascii 1.0\nelement f 1\nproperty list float int x\n",
          "no type that is known");
  refused("ply\nelement f 1\nend_header\n", "states no format");
  refused("ply\nformat ascii 1.0\n", "does not end");
  refused(text(kVertices, "0 0 0\n1 0 0\n"), "announces");
  refused(text(kVertices, "0 0 0 1 0 0 0 1 0 0 0 1"), "no faces");
  refused(text("element vertex 1\nproperty float x\n", "0"), "no x, y and z");
  refused("solid x", "is no PLY");
}

TEST(PlyReader, ListsHaveWholeNumbersOfItems) {
  EXPECT_FALSE(read_ply(text(kVertices + kFaces, "0 0 0\n1 0 0\n0 1 0\n0 0 1\n2.5 0 1 2\n")));
}

/// Each would take a second of a file that has none of their bytes.
TEST(PlyReader, ElementsWithoutPropertiesAreNotCounted) {
  std::string none;
  for (int i = 0; i < 1000; ++i) none += "element edge 4294967295\nelement other 4294967295\n";
  const Result<model::Model> model =
      read_ply(text(kVertices + kFaces + none, "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n"));
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(std::get<TriangleMesh>(model->shapes[0]).triangles.size(), 1U);
}

/// Counts that no file of this size can hold are refused before memory is requested.
TEST(PlyReader, HostileCountsAreRefused) {
  for (const char* const count : {"4294967295", "18446744073709551615", "1000000000000"}) {
    const std::string head = std::string("element vertex ") + count +
                             "\nproperty float x\nproperty float y\nproperty float z\n";
    EXPECT_FALSE(read_ply(text(head, "0 0 0\n")));
    EXPECT_FALSE(
        read_ply("ply\nformat binary_little_endian 1.0\n" + head + "end_header\n123456789012"));
    EXPECT_FALSE(read_ply(std::string("ply\nformat ascii 1.0\nelement nothing ") + count +
                          "\nend_header\n"));
  }
  EXPECT_FALSE(read_ply(text(kVertices + "element face 1\nproperty list uint int vertex_index\n",
                             "0 0 0 1 0 0 0 1 0 0 0 1 4294967295 0 1 2")));
}

}  // namespace
}  // namespace strake::io
