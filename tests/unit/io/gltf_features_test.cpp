// SPDX-License-Identifier: Apache-2.0
// Property tables of EXT_structural_metadata as attributes of instances and of meshes.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "io/gltf/features/schema.hpp"
#include "strake/io/reader.hpp"
#include "support/gltf_files.hpp"
#include "support/io_files.hpp"
#include "support/model_check.hpp"

namespace strake::io {
namespace {

using model::Attributes;
using test::bytes_of;

Result<model::Model> read_features(const std::string& bytes) {
  return test::read_bytes(*make_gltf_reader(), bytes, "x.glb");
}

/// A document of three instances, whose second has row 0, first row 2 and third no row, and of a
/// mesh that is row 1. Columns of all kinds. `from` of its JSON is written as `to`.
std::string features_document(const std::string& from = "", const std::string& to = "") {
  std::string binary, views;
  const auto view = [&](const std::string& bytes) {
    views += (views.empty() ? "" : ",") + std::string(R"({"buffer":0,"byteOffset":)") +
             std::to_string(binary.size()) + R"(,"byteLength":)" + std::to_string(bytes.size()) +
             "}";
    binary += bytes;
    binary.resize((binary.size() + 7) / 8 * 8);
  };
  view(bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 2, 0}));         // 0
  view(bytes_of(std::vector<float>{1, 0, 0, 2, 0, 0, 3, 0, 0}));         // 1
  view(bytes_of(std::vector<std::uint16_t>{2, 0, 9}));                   // 2
  view("F60F90");                                                        // 3
  view(bytes_of(std::vector<std::uint32_t>{0, 3, 3, 6}));                // 4
  view(bytes_of(std::vector<double>{0.5, -1, 2.25}));                    // 5
  view(std::string(1, '\x05'));                                          // 6
  view(bytes_of(std::vector<std::uint8_t>{1, 0, 7}));                    // 7
  view(bytes_of(std::vector<std::int16_t>{1, 2, 3, 4, 5, 6, 7, 8, 9}));  // 8
  view(bytes_of(std::vector<std::uint32_t>{0, 1, 1, 3}));                // 9
  view(bytes_of(std::vector<std::uint8_t>{11, 12, 13}));                 // 10
  view(bytes_of(std::vector<std::uint8_t>{1, 1, 1}));                    // 11
  view("T1T2T3");                                                        // 12
  view(std::string("\0\2\4\6", 4));                                      // 13
  std::string text =
      R"({"asset":{"version":"2.0"},"extensionsUsed":["EXT_structural_metadata"],"buffers":[)"
      R"({"byteLength":)" +
      std::to_string(binary.size()) + R"(}],"bufferViews":[)" + views +
      R"(],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
      R"({"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"},)"
      R"({"bufferView":2,"componentType":5123,"count":3,"type":"SCALAR"},)"
      R"({"bufferView":11,"componentType":5121,"count":3,"type":"SCALAR"}],)"
      R"("extensions":{"EXT_structural_metadata":{"schema":{"id":"s","classes":{"Pset_WallCommon":)"
      R"({"properties":{"FireRating":{"type":"STRING"},"Width":{"type":"SCALAR","componentType":)"
      R"("FLOAT64","noData":-1},"IsExternal":{"type":"BOOLEAN"},"Status":{"type":"ENUM","enumType":)"
      R"("status"},"Place":{"type":"VEC3","componentType":"INT16"},"Codes":{"type":"SCALAR",)"
      R"("componentType":"UINT8","array":true},"Share":{"type":"SCALAR","componentType":"UINT8",)"
      R"("normalized":true,"scale":100},"Tag":{"type":"STRING","semantic":"ID"}}}},"enums":{"status":)"
      R"({"valueType":"UINT8","values":[{"name":"NEW","value":0},{"name":"OLD","value":1}]}}},)"
      R"("propertyTables":[{"class":"Pset_WallCommon","count":3,"properties":{)"
      R"("FireRating":{"values":3,"stringOffsets":4},"Width":{"values":5},"IsExternal":{"values":6},)"
      R"("Status":{"values":7},"Place":{"values":8},"Codes":{"values":10,"arrayOffsets":9},)"
      R"("Share":{"values":11},"Tag":{"values":12,"stringOffsets":13,"stringOffsetType":"UINT8"}}}]}},)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]},{"primitives":[{"attributes":)"
      R"({"POSITION":0,"_FEATURE_ID_0":3},"extensions":{"EXT_mesh_features":{"featureIds":)"
      R"([{"featureCount":1,"attribute":0,"propertyTable":0}]}}}]}],)"
      R"("nodes":[{"name":"walls","mesh":0,"extras":{"Storey":"1"},"extensions":)"
      R"({"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":1,"_FEATURE_ID_0":2}},)"
      R"("EXT_instance_features":{"featureIds":[{"featureCount":2,"attribute":0,"nullFeatureId":9,)"
      R"("propertyTable":0}]}}},{"name":"one","mesh":1}]})";
  text.replace(text.find(from), from.size(), to);
  return test::glb(text, binary);
}

TEST(GltfFeatures, RowsBecomeAttributesUnderTheNameOfTheirClass) {
  const Result<model::Model> model = read_features(features_document());
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_TRUE(model->diagnostics.kept().empty());
  ASSERT_EQ(model->objects.size(), 4U);
  const std::string set = "Pset_WallCommon.";
  EXPECT_EQ(model->objects[0].attributes,
            (Attributes{{set + "FireRating", "F90"},
                        {set + "Width", "2.25"},
                        {set + "IsExternal", "true"},
                        {set + "Status", "7"},
                        {set + "Place", "7, 8, 9"},
                        {set + "Codes", "12; 13"},
                        {set + "Share", model->objects[0].attributes.at(6).second},
                        {set + "Tag", "T3"}}));
  EXPECT_NEAR(std::stod(model->objects[0].attributes[6].second), 100.0 / 255, 1e-12);
  EXPECT_EQ(model->objects[0].id, "T3");
  EXPECT_FALSE(model->objects[0].positional_id);
  EXPECT_EQ(model->objects[1].attributes[3].second, "OLD");
  EXPECT_EQ(model->objects[1].attributes[5],
            (std::pair<std::string, std::string>{set + "Codes", "11"}));
  EXPECT_TRUE(model->objects[2].attributes.empty());
  EXPECT_EQ(model->objects[2].name, "instance 2");
  EXPECT_EQ(model->path(model->objects[2]), "walls");
  EXPECT_EQ(model->stated(model->objects[2], "Storey").group, model->objects[2].parent);
  // Neither its empty text nor what the schema takes for none is said of the mesh.
  ASSERT_EQ(model->objects[3].attributes.size(), 5U);
  EXPECT_EQ(model->objects[3].attributes[0].first, set + "IsExternal");
  EXPECT_EQ(model->objects[3].attributes[0].second, "false");
}

/// A mesh is of one storey and has parts that are features of their own: what is said of all of it
/// counts.
TEST(GltfFeatures, OfSeveralSetsThoseByWhichAMeshIsOneFeatureCount) {
  const Result<model::Model> model = read_features(
      features_document(R"("_FEATURE_ID_0":3},"extensions":{"EXT_mesh_features":{"featureIds":)"
                        R"([{"featureCount":1,"attribute":0,"propertyTable":0}])",
                        R"("_FEATURE_ID_0":2,"_FEATURE_ID_1":3},"extensions":{"EXT_mesh_features":)"
                        R"({"featureIds":[{"featureCount":3,"attribute":0,"propertyTable":0},)"
                        R"({"featureCount":1,"attribute":1,"propertyTable":0}])"));
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(model->diagnostics.count("gltf-features"), 1U);
  ASSERT_EQ(model->objects[3].attributes.size(), 5U);
  EXPECT_EQ(model->objects[3].attributes[0].second, "false");
}

/// A number that is none costs the instance that it belongs to, and no other.
TEST(GltfFeatures, SkipsAnInstanceWithoutAPlace) {
  const float none = std::numeric_limits<float>::quiet_NaN();
  const std::string binary = bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 2, 0}) +
                             bytes_of(std::vector<float>{1, 0, 0, 0, none, 0, 0, 0, 3});
  const Result<model::Model> model = read_features(
      test::glb(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":72}],)"
                R"("bufferViews":[{"buffer":0,"byteLength":36},)"
                R"({"buffer":0,"byteOffset":36,"byteLength":36}],)"
                R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
                R"({"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"}],)"
                R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
                R"("nodes":[{"name":"bolts","mesh":0,"extensions":{"EXT_mesh_gpu_instancing":)"
                R"({"attributes":{"TRANSLATION":1}}}}]})",
                binary));
  ASSERT_TRUE(model) << model.error().text();
  ASSERT_EQ(model->objects.size(), 3U);
  ASSERT_EQ(model->bodies.size(), 2U);
  EXPECT_TRUE(model->objects[1].incomplete);
  EXPECT_FALSE(model->objects[0].incomplete || model->objects[2].incomplete);
  EXPECT_EQ(model->bodies[1].placement.translation, (geometry::Vec3d{0, -3000, 0}));
  EXPECT_EQ(model->diagnostics.skipped(), 1U);
  EXPECT_NE(model->diagnostics.kept().back().message.find("'instance 1' is skipped"),
            std::string::npos)
      << model->diagnostics.kept().back().message;
}

/// A number that can be none of a list's is named as the file writes it.
TEST(GltfFeatures, NamesAWrongNumberAsItIsWritten) {
  for (const char* const number : {"-1", "1.5", "\"x\"", "1e99", "7"}) {
    const Result<model::Model> model = read_features(test::glb(
        std::string(R"({"asset":{"version":"2.0"},"accessors":[],"meshes":[{"primitives":)"
                    R"([{"attributes":{"POSITION":)") +
        number + R"(}}]}],"nodes":[{"mesh":0}]})"));
    ASSERT_FALSE(model);
    const std::string text = model.error().text();
    std::string written = number;
    std::erase(written, '"');
    EXPECT_NE(text.find("/accessors/" + written), std::string::npos) << text;
    EXPECT_EQ(text.find("18446744073709551615"), std::string::npos) << text;
  }
}

/// What stands for nothing is stated as it is stored, before what makes values of that, and however
/// a writer of JSON spells numbers.
TEST(GltfFeatures, WhatStandsForNothingIsComparedAsStored) {
  const auto attributes = [](const std::string& column, const std::string& more,
                             std::size_t object) {
    const Result<model::Model> model = read_features(features_document(column, column + more));
    EXPECT_TRUE(model) << model.error().text();
    return model ? model->objects[object].attributes : Attributes{};
  };
  const std::string width = R"("componentType":"FLOAT64")", share = R"("scale":100)",
                    codes = R"("componentType":"UINT8","array":true)";
  using Attribute = Attributes::value_type;
  // Of repeated keys the first counts.
  EXPECT_EQ(attributes(width, R"(,"noData":-1.0,"default":7.50)", 3)[0],
            Attribute("Pset_WallCommon.Width", "7.5"));
  EXPECT_EQ(attributes(width, R"(,"noData":-10,"offset":-9,"default":1)", 3)[0],
            Attribute("Pset_WallCommon.Width", "-10"));
  EXPECT_EQ(attributes(share, R"(,"noData":1,"default":0.25)", 0)[6],
            Attribute("Pset_WallCommon.Share", "0.25"));
  EXPECT_EQ(attributes(codes, R"(,"noData":[12,13],"default":[1,2])", 0)[5],
            Attribute("Pset_WallCommon.Codes", "1; 2"));
}

/// Thousands of columns may be of an enumeration of thousands of values.
TEST(GltfFeatures, ColumnsShareTheWordsOfAnEnumeration) {
  const std::string text =
      R"({"classes":{"c":{"properties":{"p":{"type":"STRING"},"p":7}}},"enums":{"e":{"valueType":)"
      R"("INT8","values":[{"name":"A","value":-1},{"name":"B","value":2}]}}})";
  const Result<gltf::JsonDocument> document = gltf::JsonDocument::parse(text);
  ASSERT_TRUE(document);
  gltf::Schema schema(document->root());
  const auto words = schema.enumeration("e");
  ASSERT_NE(words, nullptr);
  EXPECT_EQ(words->words, (std::map<std::int64_t, std::string>{{-1, "A"}, {2, "B"}}));
  EXPECT_EQ(schema.enumeration("e"), words);
  EXPECT_EQ(schema.enumeration("f"), nullptr);
  EXPECT_TRUE(schema.property("c", "p").is_object()) << "of repeated keys the first counts";
  EXPECT_FALSE(schema.property("c", "q").exists());
  EXPECT_FALSE(schema.property("d", "p").exists());
}

TEST(GltfFeatures, WhatCannotBeReadIsReported) {
  std::string bytes = features_document();
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string other = bytes;
    EXPECT_EQ(from.size(), to.size());
    other.replace(other.find(from), from.size(), to);
    return read_features(other);
  };
  const auto column = replaced(R"("Width":{"values":5})", R"("Width":{"valuez":5})");
  ASSERT_TRUE(column);
  EXPECT_EQ(column->diagnostics.count("gltf-metadata"), 1U);
  EXPECT_EQ(column->objects[0].attributes.size(), 7U);
  const auto type = replaced(R"("type":"BOOLEAN")", R"("type":"WHATEVR")");
  ASSERT_TRUE(type);
  EXPECT_EQ(type->diagnostics.count("gltf-metadata"), 1U);
  EXPECT_EQ(type->objects[0].attributes.size(), 7U);
  // Two features within a mesh.
  const std::string ids = std::string("\1\1\1\0", 4);
  const auto several = replaced(ids, std::string("\1\2\1\0", 4));
  ASSERT_TRUE(several);
  EXPECT_EQ(several->diagnostics.count("gltf-features"), 1U);
  EXPECT_TRUE(several->objects[3].attributes.empty());
}

TEST(GltfFeatures, DamageIsSurvived) {
  const std::string whole = features_document();
  std::mt19937 random(11);
  for (int round = 0; round < 3000; ++round) {
    std::string bytes = whole;
    for (std::size_t k = 0; k < 1 + random() % 3; ++k) {
      char& byte = bytes[random() % bytes.size()];
      byte =
          random() % 2 == 0 ? static_cast<char>('0' + random() % 10) : static_cast<char>(random());
    }
    if (round % 10 == 0) bytes.resize(random() % bytes.size());
    const Result<model::Model> model = read_features(bytes);
    if (model) {
      EXPECT_EQ(test::model_fault(*model), "") << round;
    }
  }
}

}  // namespace
}  // namespace strake::io
