// SPDX-License-Identifier: Apache-2.0
// EXT_meshopt_compression: what the library packs is read as if it were plain, and damage is an
// error or a model without the object.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "strake/io/reader.hpp"
#include "support/equal_models.hpp"
#include "support/gltf_files.hpp"
#include "support/io_files.hpp"
#include "support/io_models.hpp"
#include "support/model_check.hpp"

namespace strake::io {
namespace {

using test::bytes_of;

/// One view: its plain bytes, its packed ones, and what the extension says of these.
struct View {
  std::string plain, packed, words;
  std::size_t stride = 0;  ///< that the plain view states; 0: none
};

View packed_view(const std::string& plain, std::size_t stride, const std::string& packed,
                 const std::string& mode) {
  return {
      plain, packed,
      fmt::format(R"("byteStride":{},"count":{},"mode":{})", stride, plain.size() / stride, mode)};
}

View attributes(const std::string& plain, std::size_t stride) {
  const std::size_t count = plain.size() / stride;
  std::string packed(meshopt_encodeVertexBufferBound(count, stride), '\0');
  packed.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(packed.data()),
                                           packed.size(), plain.data(), count, stride));
  View view = packed_view(plain, stride, packed, R"("ATTRIBUTES")");
  view.stride = stride;
  return view;
}

/// `exponential` are the numbers of the filter, which become `plain`.
View exponential(std::vector<float> numbers) {
  const std::size_t count = numbers.size() / 3;
  std::vector<std::uint32_t> filtered(numbers.size());
  meshopt_encodeFilterExp(filtered.data(), count, 12, 20, numbers.data());
  View view = attributes(bytes_of(filtered), 12);
  view.words += R"(,"filter":"EXPONENTIAL")";
  meshopt_decodeFilterExp(filtered.data(), count, 12);
  view.plain = bytes_of(filtered);
  return view;
}

View triangles(const std::vector<std::uint16_t>& indices, std::size_t vertices) {
  std::string packed(meshopt_encodeIndexBufferBound(indices.size(), vertices), '\0');
  packed.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(packed.data()),
                                          packed.size(), indices.data(), indices.size()));
  // Corners of a triangle may come back turned.
  std::vector<std::uint16_t> turned(indices.size());
  EXPECT_EQ(meshopt_decodeIndexBuffer(turned.data(), turned.size(),
                                      reinterpret_cast<const unsigned char*>(packed.data()),
                                      packed.size()),
            0);
  return packed_view(bytes_of(turned), 2, packed, R"("TRIANGLES")");
}

View sequence(const std::vector<std::uint16_t>& indices, std::size_t vertices) {
  std::string packed(meshopt_encodeIndexSequenceBound(indices.size(), vertices), '\0');
  packed.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(packed.data()),
                                            packed.size(), indices.data(), indices.size()));
  return packed_view(bytes_of(indices), 2, packed, R"("INDICES")");
}

/// A GLB of the views with `rest` behind them, all plain or all packed.
std::string document(const std::vector<View>& views, const std::string& rest, bool packed) {
  std::string binary, json;
  for (const View& view : views) {
    const std::string& bytes = packed ? view.packed : view.plain;
    json += json.empty() ? "{" : ",{";
    json += packed ? fmt::format(R"("buffer":1,"byteLength":{},"extensions":)"
                                 R"({{"EXT_meshopt_compression":{{"buffer":0,"byteOffset":{},)"
                                 R"("byteLength":{},{}}}}})",
                                 view.plain.size(), binary.size(), bytes.size(), view.words)
                   : fmt::format(R"("buffer":0,"byteOffset":{},"byteLength":{})", binary.size(),
                                 bytes.size());
    if (!packed && view.stride != 0) json += fmt::format(R"(,"byteStride":{})", view.stride);
    json += '}';
    binary += bytes;
    binary.resize((binary.size() + 3) / 4 * 4);
  }
  return test::glb(
      R"({"asset":{"version":"2.0"},"extensionsRequired":["EXT_meshopt_compression"],)" +
          fmt::format(R"("buffers":[{{"byteLength":{}}},{{"byteLength":4096}}],)", binary.size()) +
          R"("bufferViews":[)" + json + "]," + rest + "}",
      binary);
}

std::vector<float> box_corners() {
  std::vector<float> numbers;
  for (const geometry::Vec3d& v : test::box_mesh(0.37, 5, 1.25).vertices)
    for (const double x : {v.x, v.y, v.z}) numbers.push_back(static_cast<float>(x));
  return numbers;
}

std::vector<std::uint16_t> box_indices() {
  std::vector<std::uint16_t> indices;
  for (const geometry::Triangle& t : test::box_mesh(1, 1, 1).triangles)
    for (const std::uint32_t corner : t) indices.push_back(static_cast<std::uint16_t>(corner));
  return indices;
}

const std::string kFloatAccessors =
    R"("accessors":[{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3"},)"
    R"({"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"}],)"
    R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
    R"("nodes":[{"mesh":0,"name":"box"}])";

Result<model::Model> read(const std::string& bytes) {
  return test::read_bytes(*make_gltf_reader(), bytes, "x.glb");
}

std::string difference(const std::vector<View>& views, const std::string& rest) {
  Result<model::Model> plain = read(document(views, rest, false));
  const Result<model::Model> packed = read(document(views, rest, true));
  EXPECT_TRUE(plain);
  if (!packed) return packed.error().text();
  plain->files = packed->files;
  return test::model_difference(*plain, *packed);
}

TEST(GltfPacked, FloatsAndTriangles) {
  EXPECT_EQ(difference({attributes(bytes_of(box_corners()), 12), triangles(box_indices(), 8)},
                       kFloatAccessors),
            "");
}

TEST(GltfPacked, ExponentialFilter) {
  EXPECT_EQ(difference({exponential(box_corners()), triangles(box_indices(), 8)}, kFloatAccessors),
            "");
}

TEST(GltfPacked, QuantisedLinesAndInstances) {
  const std::vector<std::int16_t> points{0, 0, 0, 0, 100, -7, 32767, 0, 5, 5, 5, 0};
  const View turns = [] {
    const std::vector<float> quaternions{0, 0, 0, 1, 0.5F, 0.5F, 0.5F, 0.5F};
    std::vector<std::int16_t> filtered(8);
    meshopt_encodeFilterQuat(filtered.data(), 2, 8, 12, quaternions.data());
    View view = attributes(bytes_of(filtered), 8);
    view.words += R"(,"filter":"QUATERNION")";
    meshopt_decodeFilterQuat(filtered.data(), 2, 8);
    view.plain = bytes_of(filtered);
    return view;
  }();
  EXPECT_EQ(
      difference(
          {attributes(bytes_of(points), 8), sequence({0, 1, 1, 2}, 3), turns},
          R"("accessors":[{"bufferView":0,"componentType":5122,"count":2,"type":"VEC3"},)"
          R"({"bufferView":1,"componentType":5123,"count":2,"type":"SCALAR"},)"
          R"({"bufferView":2,"componentType":5122,"normalized":true,"count":2,"type":"VEC4"}],)"
          R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":1}]}],)"
          R"("nodes":[{"mesh":0,"name":"axis","extensions":{"EXT_mesh_gpu_instancing":)"
          R"({"attributes":{"ROTATION":2}}}}])"),
      "");
}

TEST(GltfPacked, WhatItsBytesCannotHoldIsRefusedBeforeMemoryIsAskedFor) {
  std::vector<View> views{attributes(bytes_of(box_corners()), 12), triangles(box_indices(), 8)};
  views[0].words = R"("byteStride":12,"count":4000000000,"mode":"ATTRIBUTES")";
  const Result<model::Model> refused = read(document(views, kFloatAccessors, true));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("cannot hold"), std::string::npos)
      << refused.error().text();
  for (const char* const words :
       {R"("byteStride":12,"count":8,"mode":"TRIANGLES")",
        R"("byteStride":0,"count":8,"mode":"INDICES")",
        R"("byteStride":12,"count":8,"mode":"ATTRIBUTES","filter":"QUATERNION")",
        R"("byteStride":12,"count":8,"mode":"COLOURS")",
        R"("byteStride":12,"mode":"ATTRIBUTES")"}) {
    views[0].words = words;
    EXPECT_FALSE(read(document(views, kFloatAccessors, true))) << words;
  }
}

/// Bytes of a view or of the document that are changed or cut off never do worse than lose the
/// object.
TEST(GltfPacked, DamageIsSurvived) {
  const std::string whole =
      document({exponential(box_corners()), triangles(box_indices(), 8)}, kFloatAccessors, true);
  std::mt19937 random(7);
  for (int round = 0; round < 1500; ++round) {
    std::string bytes = whole;
    const std::size_t damaged = 1 + random() % 3;
    // Two in three rounds in the packed bytes at the end.
    const std::size_t from = round % 3 == 0 ? 0 : bytes.size() - 130;
    for (std::size_t k = 0; k < damaged; ++k)
      bytes[from + random() % (bytes.size() - from)] = static_cast<char>(random());
    if (round % 10 == 0) bytes.resize(random() % bytes.size());
    const Result<model::Model> model = read(bytes);
    if (model) {
      EXPECT_EQ(test::model_fault(*model), "") << round;
    }
  }
}

}  // namespace
}  // namespace strake::io
