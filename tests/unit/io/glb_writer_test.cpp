// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stop_token>
#include <string>
#include <vector>

#include "core/text_encoding.hpp"
#include "io/gltf/srgb.hpp"
#include "strake/io/writer.hpp"
#include "support/io_files.hpp"
#include "support/io_models.hpp"

namespace strake::io {
namespace {

using nlohmann::json;

/// A GLB taken apart by the letter of its specification.
struct Glb {
  json document;
  std::string binary;
};

std::uint32_t word(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

Glb write_and_split(const model::Model& model, const WriteOptions& options = {}) {
  const test::TemporaryFolder folder;
  const Status written = write_glb(model, folder.path() / "x.glb", options, {});
  EXPECT_TRUE(written) << (written ? "" : written.error().text());
  std::ifstream file(folder.path() / "x.glb", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(word(bytes, 4), 2U);
  EXPECT_EQ(word(bytes, 8), bytes.size());
  const std::uint32_t json_length = word(bytes, 12);
  EXPECT_EQ(json_length % 4, 0U);
  EXPECT_EQ(word(bytes, 16), 0x4E4F534AU);
  Glb glb;
  glb.document = json::parse(bytes.substr(20, json_length));
  if (bytes.size() > 20 + json_length) {
    EXPECT_EQ(word(bytes, 20 + json_length) + 28 + json_length, bytes.size());
    EXPECT_EQ(word(bytes, 24 + json_length), 0x004E4942U);
    glb.binary = bytes.substr(28 + json_length);
    EXPECT_EQ(glb.document["buffers"][0]["byteLength"], glb.binary.size());
  }
  return glb;
}

const json& node(const Glb& glb, const std::string& id) {
  for (const json& one : glb.document["nodes"])
    if (one.contains("extras") && one["extras"]["id"] == id) return one;
  ADD_FAILURE() << "no node " << id;
  return glb.document["nodes"][0];
}

std::vector<float> positions(const Glb& glb, const json& primitive) {
  const json& accessor =
      glb.document["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
  const json& view = glb.document["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  EXPECT_EQ(accessor["componentType"], 5126);
  EXPECT_EQ(view["byteStride"], 12);
  std::vector<float> numbers(3 * accessor["count"].get<std::size_t>());
  const std::size_t at = view.value("byteOffset", 0U) + accessor["byteOffset"].get<std::size_t>();
  std::memcpy(numbers.data(), glb.binary.data() + at, numbers.size() * 4);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    EXPECT_GE(numbers[i], accessor["min"][i % 3].get<float>());
    EXPECT_LE(numbers[i], accessor["max"][i % 3].get<float>());
  }
  return numbers;
}

TEST(GlbWriter, WritesObjectsAsNodesThatShareMeshes) {
  const Glb glb = write_and_split(test::sample_model());
  EXPECT_EQ(glb.document["asset"]["version"], "2.0");
  EXPECT_EQ(glb.document["nodes"].size(), 7U) << "two groups and five objects";
  EXPECT_EQ(node(glb, "one")["mesh"], node(glb, "two")["mesh"]) << "equal shape and colour";
  EXPECT_NE(node(glb, "one")["mesh"], node(glb, "four")["mesh"]) << "another colour";
  EXPECT_EQ(node(glb, "one")["name"], "Box Ä\n");
  EXPECT_EQ(node(glb, "two")["extras"]["path"], "Deck \"A\"/Frame 7/8");
  EXPECT_EQ(node(glb, "one")["extras"]["attributes"],
            json::parse(R"({"weight": "12 kg", "weight#2": "13 kg"})"));
  const json& deck = glb.document["nodes"][0];
  EXPECT_EQ(deck["name"], "Deck \"A\"");
  EXPECT_EQ(deck["children"], json::parse("[1, 2]"));
  EXPECT_EQ(glb.document["scenes"][0]["nodes"], json::parse("[0, 4, 6]"));
}

TEST(GlbWriter, GroupsKeepTheirAttributes) {
  model::Model model = test::sample_model();
  model.set_attributes(model::GroupId{0}, {{"AREA", "7"}, {"AREA", "\"8\""}});
  const Glb glb = write_and_split(model);
  EXPECT_EQ(glb.document["nodes"][0]["extras"],
            json::parse(R"({"attributes": {"AREA": "7", "AREA#2": "\"8\""}})"));
  EXPECT_FALSE(glb.document["nodes"][1].contains("extras"));
}

TEST(GlbWriter, TurnsToMetresWithYUp) {
  const Glb glb = write_and_split(test::sample_model());
  EXPECT_EQ(node(glb, "one")["matrix"],
            json::parse("[1,0,0,0, 0,1,0,0, 0,0,1,0, 0.01,0.03,-0.02,1]"));
  // A quarter turn about model z is one about file y: x goes to -z.
  EXPECT_EQ(node(glb, "two")["matrix"], json::parse("[0,0,-1,0, 0,1,0,0, 1,0,0,0, 5,0,0,1]"));
  const json& mesh = glb.document["meshes"][node(glb, "one")["mesh"].get<std::size_t>()];
  const std::vector<float> numbers = positions(glb, mesh["primitives"][0]);
  ASSERT_EQ(numbers.size(), 24U);
  EXPECT_EQ(std::vector<float>(numbers.end() - 3, numbers.end()),
            (std::vector<float>{1.0F, 0.25F, -0.5F}));
}

TEST(GlbWriter, WritesMillimetresWithZUpWhenRequested) {
  WriteOptions options;
  options.millimetres_z_up = true;
  const Glb glb = write_and_split(test::sample_model(), options);
  EXPECT_EQ(glb.document["asset"]["extras"], json::parse(R"({"unit_mm": 1, "up_axis": "z"})"));
  EXPECT_EQ(node(glb, "two")["matrix"], json::parse("[0,1,0,0, -1,0,0,0, 0,0,1,0, 5000,0,0,1]"));
}

TEST(GlbWriter, WritesBodiesOfOneObjectAsOneMesh) {
  WriteOptions options;
  options.millimetres_z_up = true;
  const Glb glb = write_and_split(test::sample_model(), options);
  const json& pair = node(glb, "three");
  const json& primitives = glb.document["meshes"][pair["mesh"].get<std::size_t>()]["primitives"];
  ASSERT_EQ(primitives.size(), 2U);
  // The second box lies 1000 above the first in the world; in the first's turned frame its far
  // corner (1000, 500, 1250) is (500, -1000, 1250).
  const std::vector<float> second = positions(glb, primitives[1]);
  EXPECT_EQ(std::vector<float>(second.end() - 3, second.end()),
            (std::vector<float>{500, -1000, 1250}));
}

TEST(GlbWriter, WritesColoursAndLines) {
  const Glb glb = write_and_split(test::sample_model());
  const auto material_of = [&](const std::string& id) {
    const json& mesh = glb.document["meshes"][node(glb, id)["mesh"].get<std::size_t>()];
    return glb.document["materials"][mesh["primitives"][0]["material"].get<std::size_t>()];
  };
  EXPECT_EQ(material_of("one")["pbrMetallicRoughness"]["baseColorFactor"],
            json::parse("[1.0, 0.0, 0.0, 1.0]"));
  EXPECT_FALSE(material_of("one").contains("alphaMode"));
  EXPECT_EQ(material_of("four")["alphaMode"], "BLEND");
  const json& axis =
      glb.document["meshes"][node(glb, "five")["mesh"].get<std::size_t>()]["primitives"][0];
  EXPECT_EQ(axis["mode"], 1);
  const json& indices = glb.document["accessors"][axis["indices"].get<std::size_t>()];
  EXPECT_EQ(indices["count"], 6);
  EXPECT_EQ(indices["componentType"], 5123);
}

TEST(GlbWriter, MeshesStateHowExactTheyAreWhereAllOfThemIsKnown) {
  model::Model model;
  geometry::TriangleMesh flat = test::box_mesh(1000, 1000, 1000), round = flat;
  flat.sag_mm = 0;
  round.sag_mm = 0.25;
  const std::array<model::ShapeId, 3> shapes{test::add_shape(model, flat),
                                             test::add_shape(model, round),
                                             test::add_shape(model, test::box_mesh(1, 2, 3))};
  geometry::Placement twice;
  twice.linear.row = {{{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}};
  test::add_object(model, "flat", "flat");
  test::add_body(model, shapes[0], {});
  test::add_object(model, "both", "both");
  test::add_body(model, shapes[0], {});
  test::add_body(model, shapes[1], twice);
  test::add_object(model, "one unknown", "one unknown");
  test::add_body(model, shapes[1], {});
  test::add_body(model, shapes[2], {});
  const Glb glb = write_and_split(model);
  const auto mesh_of = [&](const std::string& id) {
    return glb.document["meshes"][node(glb, id)["mesh"].get<std::size_t>()];
  };
  EXPECT_EQ(mesh_of("flat")["extras"], json::parse(R"({"sag_mm": 0})"));
  EXPECT_NEAR(mesh_of("both")["extras"]["sag_mm"].get<double>(), 0.5, 1e-9);
  EXPECT_FALSE(mesh_of("one unknown").contains("extras"));
}

TEST(GlbWriter, UsesWideIndicesForLargeMeshes) {
  model::Model model;
  geometry::TriangleMesh strip;
  const std::uint32_t count = 66000;
  for (std::uint32_t i = 0; i < count; ++i)
    strip.vertices.push_back({static_cast<double>(i), i % 2 == 0 ? 0.0 : 1.0, 0});
  for (std::uint32_t i = 2; i < count; ++i) strip.triangles.push_back({i - 2, i - 1, i});
  const model::ShapeId large = test::add_shape(model, strip);
  const model::ShapeId small = test::add_shape(model, test::box_mesh(1, 2, 3));
  test::add_object(model, "large", "large");
  test::add_body(model, large, {});
  test::add_object(model, "small", "small");
  test::add_body(model, small, {});
  const Glb glb = write_and_split(model);
  const json& accessor = glb.document["accessors"][1];
  EXPECT_EQ(accessor["componentType"], 5125);
  const json& view = glb.document["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  const std::size_t last =
      view["byteOffset"].get<std::size_t>() + 4 * (accessor["count"].get<std::size_t>() - 1);
  EXPECT_EQ(word(glb.binary, last), count - 1);
  EXPECT_EQ(glb.document["accessors"][3]["componentType"], 5123);
  EXPECT_EQ(glb.document["bufferViews"].size(), 3U);
}

TEST(GlbWriter, WritesAnEmptyModel) {
  const Glb glb = write_and_split(model::Model{});
  EXPECT_EQ(glb.document["scenes"].size(), 1U);
  EXPECT_TRUE(glb.binary.empty());
}

TEST(GlbWriter, RefusesCoordinatesThatAreNotFinite) {
  model::Model model;
  geometry::TriangleMesh mesh = test::box_mesh(1, 1, 1);
  mesh.vertices[3].y = std::nan("");
  const model::ShapeId shape = test::add_shape(model, mesh);
  test::add_object(model, "bad", "bad");
  test::add_body(model, shape, {});
  const test::TemporaryFolder folder;
  const Status written = write_glb(model, folder.path() / "x.glb", {}, {});
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().where, "bad");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "x.glb"));
}

TEST(GlbWriter, LeavesNothingWhenStopped) {
  const std::stop_source stop;
  stop.request_stop();
  parallel::Context context;
  context.stop = stop.get_token();
  const test::TemporaryFolder folder;
  for (const auto& write : {write_glb, write_obj}) {
    const Status written = write(test::sample_model(), folder.path() / "x", {}, context);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::cancelled);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  }
}

TEST(Srgb, GivesEveryValueBack) {
  for (int i = 0; i < 256; ++i) {
    const auto value = static_cast<std::uint8_t>(i);
    EXPECT_EQ(gltf::srgb_of_linear(gltf::linear_of_srgb(value)), value);
    const double share = i / 255.0;
    const double expected =
        share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
    EXPECT_NEAR(gltf::linear_of_srgb(value), expected, 1e-12);
  }
  EXPECT_EQ(gltf::srgb_of_linear(-1), 0);
  EXPECT_EQ(gltf::srgb_of_linear(2), 255);
  EXPECT_EQ(gltf::srgb_of_linear(std::nan("")), 0);
}

TEST(JsonText, EscapesAndMendsUtf8) {
  const auto text = [](std::string_view raw) {
    std::string out;
    append_json_string(out, raw);
    return json::parse(out).get<std::string>();
  };
  EXPECT_EQ(text("a\"b\\c\n\t\x01/ä€😀"), "a\"b\\c\n\t\x01/ä€😀");
  EXPECT_EQ(text("\xC4"), "\xEF\xBF\xBD");                                  // Latin-1
  EXPECT_EQ(text("\xED\xA0\x80"), "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");  // a surrogate
  EXPECT_EQ(text("\xC0\x80"), "\xEF\xBF\xBD\xEF\xBF\xBD");                  // overlong
}

}  // namespace
}  // namespace strake::io
