// SPDX-License-Identifier: Apache-2.0
// EXT_meshopt_compression and KHR_meshopt_compression: what is packed is read as if it were plain,
// and damage is an error or a model without the object.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/gltf/packed_attributes.hpp"
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
std::string packed_document(const std::vector<View>& views, const std::string& rest, bool packed) {
  std::string binary, buffer_views;
  for (const View& view : views) {
    const std::string& bytes = packed ? view.packed : view.plain;
    buffer_views += buffer_views.empty() ? "{" : ",{";
    buffer_views += packed
                        ? fmt::format(R"("buffer":1,"byteLength":{},"extensions":)"
                                      R"({{"EXT_meshopt_compression":{{"buffer":0,"byteOffset":{},)"
                                      R"("byteLength":{},{}}}}})",
                                      view.plain.size(), binary.size(), bytes.size(), view.words)
                        : fmt::format(R"("buffer":0,"byteOffset":{},"byteLength":{})",
                                      binary.size(), bytes.size());
    if (!packed && view.stride != 0)
      buffer_views += fmt::format(R"(,"byteStride":{})", view.stride);
    buffer_views += '}';
    binary += bytes;
    binary.resize((binary.size() + 3) / 4 * 4);
  }
  return test::glb(
      R"({"asset":{"version":"2.0"},"extensionsRequired":["EXT_meshopt_compression"],)" +
          fmt::format(R"("buffers":[{{"byteLength":{}}},{{"byteLength":4096}}],)", binary.size()) +
          R"("bufferViews":[)" + buffer_views + "]," + rest + "}",
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

Result<model::Model> read_packed(const std::string& bytes) {
  return test::read_bytes(*make_gltf_reader(), bytes, "x.glb");
}

std::string difference(const std::vector<View>& views, const std::string& rest) {
  Result<model::Model> plain = read_packed(packed_document(views, rest, false));
  const Result<model::Model> packed = read_packed(packed_document(views, rest, true));
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

TEST(GltfPacked, WhatItsBytesCannotHoldIsRefusedBeforeMemoryIsRequested) {
  std::vector<View> views{attributes(bytes_of(box_corners()), 12), triangles(box_indices(), 8)};
  views[0].words = R"("byteStride":12,"count":4000000000,"mode":"ATTRIBUTES")";
  const Result<model::Model> refused = read_packed(packed_document(views, kFloatAccessors, true));
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
    EXPECT_FALSE(read_packed(packed_document(views, kFloatAccessors, true))) << words;
  }
}

std::string from_hex(std::string_view digits) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
    bytes.push_back(static_cast<char>(std::stoi(std::string(digits.substr(i, 2)), nullptr, 16)));
  return bytes;
}

/// What the format's reference encoder (npm: meshoptimizer 1.3.0) made of numbers that are easily
/// made again, in version 1. Together they have all kinds of channels, controls and widths.
struct Packed1 {
  std::size_t stride;
  std::string plain, packed;
};

std::vector<Packed1> packed_by_version_1() {
  std::vector<float> waves;
  std::vector<std::int16_t> steps;
  std::string mixed;
  for (int i = 0; i < 21; ++i)
    for (int k = 0; k < 3; ++k)
      waves.push_back(static_cast<float>(std::floor(std::sin(i * 0.3 + k) * 64 + 0.5) / 64));
  for (int i = 0; i < 40; ++i)
    for (int k = 0; k < 4; ++k)
      steps.push_back(
          static_cast<std::int16_t>(k == 3 ? 0 : i * (k * 300 + 1) + (i % 7 == 0 ? 5000 * k : 0)));
  for (std::uint32_t i = 0; i < 33; ++i) {
    mixed += bytes_of(std::vector{i * 0x9e3779b1U});
    mixed += bytes_of(std::vector{static_cast<std::uint8_t>(i % 5 == 0),
                                  static_cast<std::uint8_t>(i * 3), std::uint8_t{7},
                                  static_cast<std::uint8_t>(i % 3)});
  }
  // clang-format off
  const std::string box = from_hex(
      "a1ff695a0043434343434343000a0a0a0a0a0a0a00d7d7d7d7d7d7d700ebebebebebebeb0108880000005400"
      "050505001000bf0010007e000000000000000000000000000000000000000000423200");
  const std::string wave = from_hex(
      "a1e87a7a0102080f2000a662160e3c3e091c7d320c307414073f3b0a126700401017476fdfcf80ef70582807"
      "2f5f87a0bf1fb0050005e000fd4e800000fe004f77d82060d8684818173f67bf3f7fbf785828000101e80017"
      "fefd010002000000000000000000000000000000583f0000683f620000");
  const std::string step = from_hex(
      "a179a7152aaaaaaaaaaaaaaaaaaa000000b55a5a5a5a5a6ab55a5a5a5a5a6ab55a5a5a5a5a6ab55a5a5a5a5a"
      "6ab55a5a5a5a5a6ab55a5a5a153aabeaaf2429242924aabeaafa29242924abea000029240049ebb96fd9ab69"
      "b7e95ba9ffa96bd9a779abd96fa9fb59a7e9bb69afd97ba9e759abe9bf59ebb91a0f63e25ff72e52ff253925"
      "596462d62ff6d272ff2e766b572cfbee00000306362d0f000000000000000000000000000000008813102700"
      "000102");
  const std::string mix = from_hex(
      "a1ff64009d9d9d9d9d9d9d9d9d9d9d9d9d9d9d9d9d9d9d9d9d9d9d9d9d9d9d9d9d9d9d9d00f2f4f4f2f4f4f2"
      "f4f4f2f4f4f2f4f4f4f2f4f4f2f4f4f2f4f4f2f4f4f4f2f4f4006e6e706e706e706e706e706e706e706e706e"
      "706e6e706e706e706e706e706e7000c3c3c3c3c1c3c3c3c3c1c3c3c3c1c3c3c3c3c1c3c3c3c3c1c3c3c3c1c3"
      "c3c3c30a10240902409024090a066666666666666666666666666666660100060a0223223223223223223223"
      "2232232232010002000000000000000000000000000000000000010007000000");
  // clang-format on
  std::vector<float> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back((i & 1) != 0 ? 0.37F : 0.0F);
    corners.push_back((i & 2) != 0 ? 5.0F : 0.0F);
    corners.push_back((i & 4) != 0 ? 1.25F : 0.0F);
  }
  return {{12, bytes_of(corners), box},
          {12, bytes_of(waves), wave},
          {8, bytes_of(steps), step},
          {8, mixed, mix}};
}

bool unpack_1(const std::string& packed, std::size_t stride, std::string& out) {
  return gltf::unpack_attributes_version_1(std::as_bytes(std::span(packed)), stride,
                                           std::as_writable_bytes(std::span(out)));
}

TEST(GltfPacked, AttributesOfVersion1) {
  for (const Packed1& one : packed_by_version_1()) {
    std::string out(one.plain.size(), 'x');
    ASSERT_TRUE(unpack_1(one.packed, one.stride, out)) << one.packed.size();
    EXPECT_EQ(out, one.plain);
    EXPECT_FALSE(unpack_1(one.packed + '\0', one.stride, out)) << "bytes are left over";
    EXPECT_FALSE(unpack_1(one.packed.substr(0, one.packed.size() - 1), one.stride, out));
    std::string too_many(2 * one.plain.size(), 'x');
    EXPECT_FALSE(unpack_1(one.packed, one.stride, too_many));
  }
}

TEST(GltfPacked, AFilePackedByVersion1) {
  const Packed1 box = packed_by_version_1().front();
  View corners = packed_view(box.plain, box.stride, box.packed, R"("ATTRIBUTES")");
  corners.stride = box.stride;
  const std::vector<View> views{corners, triangles(box_indices(), 8)};
  EXPECT_EQ(difference(views, kFloatAccessors), "");
  // Under the name that the extension has since, of the same length.
  std::string bytes = packed_document(views, kFloatAccessors, true);
  for (std::size_t at = 0; (at = bytes.find("EXT_meshopt", at)) != std::string::npos;)
    bytes.replace(at, 3, "KHR");
  const Result<model::Model> model = read_packed(bytes);
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(model->bodies.size(), 1U);
}

TEST(GltfPacked, DamageOfVersion1IsSurvived) {
  std::mt19937 random(11);
  for (const Packed1& one : packed_by_version_1())
    for (int round = 0; round < 2000; ++round) {
      std::string bytes = one.packed, out(one.plain.size(), 'x');
      for (int k = 0; k < 3; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
      bytes.resize(1 + random() % bytes.size());
      bytes.shrink_to_fit();
      EXPECT_FALSE(unpack_1(bytes, one.stride, out) && bytes.size() < one.packed.size() / 4);
    }
}

/// Bytes of a view or of the document that are changed or cut off never do worse than lose the
/// object.
TEST(GltfPacked, DamageIsSurvived) {
  const std::string whole = packed_document(
      {exponential(box_corners()), triangles(box_indices(), 8)}, kFloatAccessors, true);
  std::mt19937 random(7);
  for (int round = 0; round < 1500; ++round) {
    std::string bytes = whole;
    const std::size_t damaged = 1 + random() % 3;
    // Two in three rounds in the packed bytes at the end.
    const std::size_t from = round % 3 == 0 ? 0 : bytes.size() - 130;
    for (std::size_t k = 0; k < damaged; ++k)
      bytes[from + random() % (bytes.size() - from)] = static_cast<char>(random());
    if (round % 10 == 0) bytes.resize(random() % bytes.size());
    const Result<model::Model> model = read_packed(bytes);
    if (model) {
      EXPECT_EQ(test::model_fault(*model), "") << round;
    }
  }
}

}  // namespace
}  // namespace strake::io
