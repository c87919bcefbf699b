// SPDX-License-Identifier: Apache-2.0
// What readers say that the numbers of each body can carry.
#include "io/source/precision.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "support/gltf_files.hpp"
#include "support/io_files.hpp"
#include "support/rvm_writer.hpp"

namespace strake::io {
namespace {

using test::RvmWriter;

model::Model read_ok(const Reader& reader, std::string_view bytes) {
  Result<model::Model> model = test::read_bytes(reader, bytes, "model");
  EXPECT_TRUE(model) << (model ? "" : model.error().text());
  return model ? std::move(*model) : model::Model{};
}

std::vector<double> precisions_um(const model::Model& model) {
  std::vector<double> all;
  for (const model::Body& body : model.bodies)
    all.push_back(static_cast<double>(body.precision_um));
  return all;
}

TEST(Precision, IsALength) {
  EXPECT_EQ(precision_um(0.005), 5.0F);
  EXPECT_TRUE(std::isfinite(precision_um(1e300)));
  EXPECT_GT(precision_um(std::numeric_limits<double>::quiet_NaN()), 1e14F);
}

// The triangle of triangle_glb reaches to 2 m.
TEST(Precision, OfGltfIsThatOfVerticesAndScale) {
  const model::Model model =
      read_ok(*make_gltf_reader(),
              test::triangle_glb(R"("nodes":[{"mesh":0},{"mesh":0,"translation":[1e6,0.1,0]},)"
                                 R"({"mesh":0,"scale":[1,8,1]},{"mesh":0,"rotation":[0,0,1,0]}])"));
  const double at_2_m = 1e6 * std::ldexp(1.0, -23);
  EXPECT_EQ(precisions_um(model), (std::vector{at_2_m, at_2_m, 8 * at_2_m, at_2_m}));
  EXPECT_EQ(model.files[0].precision_mm, 8 * at_2_m / 1000) << "the worst";
  EXPECT_EQ(model.diagnostics.count("coarse-coordinates"), 0U);
}

// Decimals as a writer gives them that holds its places in single precision.
TEST(Precision, OfGltfNodesIsThatOfFloat32WhereTheyShowIt) {
  EXPECT_TRUE(came_through_float32({136.860107421875, 0, 3}));
  EXPECT_FALSE(came_through_float32({136.860107421875, 0, 0.1}));
  EXPECT_FALSE(came_through_float32({136.5, 0, 1e9}));
  EXPECT_FALSE(came_through_float32({0, 0, 0}));
  const model::Model model =
      read_ok(*make_gltf_reader(),
              test::triangle_glb(
                  R"("nodes":[{"translation":[136.860107421875,0,0],"children":[1]},{"mesh":0},)"
                  R"({"mesh":0,"translation":[136.86,0,0]}],"scenes":[{"nodes":[0,2]}])"));
  EXPECT_EQ(precisions_um(model),
            (std::vector{1e6 * std::ldexp(1.0, 8 - 25), 1e6 * std::ldexp(1.0, -23)}));
}

// Instances stand in float32 arrays.
TEST(Precision, OfGltfInstancesIsThatOfTheirPlacesToo) {
  const std::string binary =
      test::bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 2, 0, 3, 0, 0, 0, 0, 1000});
  const model::Model model = read_ok(
      *make_gltf_reader(),
      test::glb(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":60}],)"
                R"("bufferViews":[{"buffer":0,"byteLength":36},)"
                R"({"buffer":0,"byteOffset":36,"byteLength":24}],)"
                R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
                R"({"bufferView":1,"componentType":5126,"count":2,"type":"VEC3"}],)"
                R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
                R"("nodes":[{"mesh":0,"scale":[2,2,2],"extensions":{"EXT_mesh_gpu_instancing":)"
                R"({"attributes":{"TRANSLATION":1}}},"extras":{"instances":["near","far"]}}]})",
                binary));
  const auto half_step_um = [](int exponent) { return 2e6 * std::ldexp(1.0, exponent - 25); };
  EXPECT_EQ(precisions_um(model), (std::vector{half_step_um(2), half_step_um(10)}));
}

TEST(Precision, OfRvmIsThatOfMatrixAndShape) {
  RvmWriter w;
  w.head().modl().cntb("/A");
  w.prim(2, {10, 10, 10}, RvmWriter::at(336, 0, 0));   // steps of 2^-15 m
  w.prim(2, {10, 10, 10}, RvmWriter::at(1, 0, 0));     // steps of 2^-23 m
  w.prim(2, {10, 10, 40000}, RvmWriter::at(1, 0, 0));  // steps of 2^-8 mm in the box
  w.cnte().finish();
  const model::Model model = read_ok(
      *make_rvm_reader(), {reinterpret_cast<const char*>(w.bytes().data()), w.bytes().size()});
  EXPECT_EQ(precisions_um(model),
            (std::vector{1e6 * std::ldexp(1.0, -16), 1e6 * std::ldexp(1.0, -24),
                         1e3 * std::ldexp(1.0, -9)}));
}

TEST(Precision, OfTextIsThatOfAnObjectsOwnDigits) {
  const model::Model obj = read_ok(
      *make_obj_reader(),
      "v 1234.567 0 0\nv 0 1 0\nv 1 0 0\nv 123456.7 0 0\no fine\nf 1 2 3\no coarse\nf 4 2 3\n"
      "o design\nf 2 3 -3\n");
  EXPECT_EQ(precisions_um(obj),
            (std::vector{0.5, 50.0, static_cast<double>(precision_um(std::ldexp(1.0, -24)))}));
  const model::Model stl = read_ok(
      *make_stl_reader(),
      "solid a\nfacet\nvertex 0 0 0\nvertex 1234.56 0 0\nvertex 0 1 0\nendloop\nendsolid\n"
      "solid b\nfacet\nvertex 0 0 0\nvertex 1234.567 0 0\nvertex 0 1 0\nendloop\nendsolid\n");
  EXPECT_EQ(precisions_um(stl), (std::vector{5.0, 0.5}));
}

TEST(Precision, ThatMakesObjectsTouchIsReportedOncePerFile) {
  RvmWriter w;
  w.head().modl();
  for (const float x : {1.0F, 8e6F, 1e6F, 4e3F})
    w.cntb("/A").prim(2, {1, 1, 1}, RvmWriter::at(x, 0, 0)).cnte();
  w.finish();
  const model::Model model = read_ok(
      *make_rvm_reader(), {reinterpret_cast<const char*>(w.bytes().data()), w.bytes().size()});
  EXPECT_EQ(model.diagnostics.count("coarse-coordinates"), 1U);
  EXPECT_EQ(model.diagnostics.kept()[0].message.substr(0, 28), "the coordinates of 2 objects");
  EXPECT_NE(model.diagnostics.kept()[0].message.find("up to 500 mm"), std::string::npos)
      << model.diagnostics.kept()[0].message;
}

TEST(Precision, TakesHowFarTrianglesAreFromTheirSurfaces) {
  const auto sag_of = [](const char* of_all, const char* of_mesh, const ReadOptions& options) {
    const std::string text = std::string(R"({"asset":{"version":"2.0","extras":{"unit_mm":1)") +
                             of_all + R"(}},"buffers":[{"byteLength":42}],)" +
                             R"("bufferViews":[{"buffer":0,"byteLength":36},)" +
                             R"({"buffer":0,"byteOffset":36,"byteLength":6}],)" +
                             R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,)" +
                             R"("type":"VEC3"},{"bufferView":1,"componentType":5123,"count":3,)" +
                             R"("type":"SCALAR"}],"meshes":[{)" + of_mesh +
                             R"("primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)" +
                             R"("nodes":[{"mesh":0}]})";
    const std::string file =
        test::glb(text, test::bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 2, 0}) +
                            test::bytes_of(std::vector<std::uint16_t>{0, 1, 2}));
    const Result<model::Model> model =
        test::read_bytes(*make_gltf_reader(), file, "model.glb", options);
    if (!model) return std::numeric_limits<double>::quiet_NaN();
    return std::get<geometry::TriangleMesh>(model->shapes.at(0)).sag_mm;
  };
  EXPECT_LT(sag_of("", "", {}), 0) << "nothing is said";
  EXPECT_EQ(sag_of(R"(,"sag_mm":0.5)", "", {}), 0.5);
  EXPECT_EQ(sag_of(R"(,"sag_mm":0.5)", R"("extras":{"sag_mm":0},)", {}), 0);
  EXPECT_EQ(sag_of("", R"("extras":{"sag_mm":0.25},)", {}), 0.25);
  ReadOptions inches;
  inches.unit_mm = 25.4;
  EXPECT_EQ(sag_of("", R"("extras":{"sag_mm":0.25},)", inches), 25.4 * 0.25);
  for (const char* wrong : {R"("extras":{"sag_mm":-1},)", R"("extras":{"sag_mm":"1"},)",
                            R"("extras":{"sag_mm":1e999},)", R"("extras":[],)"})
    EXPECT_LT(sag_of("", wrong, {}), 0) << wrong;
}

}  // namespace
}  // namespace strake::io
