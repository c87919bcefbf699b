// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "io/gltf/accessor.hpp"
#include "io/source/input_file.hpp"
#include "strake/io/writer.hpp"
#include "support/gltf_files.hpp"
#include "support/io_files.hpp"
#include "support/io_models.hpp"

namespace strake::io {
namespace {

using geometry::Polylines;
using geometry::TriangleMesh;
using geometry::Vec3d;
using test::bytes_of;
using test::glb;
using test::triangle_glb;

Result<model::Model> read(std::string_view bytes, const ReadOptions& options = {},
                          const std::filesystem::path& path = "some/model.glb") {
  return test::read_bytes(*make_gltf_reader(), bytes, path, options);
}

model::Model read_ok(std::string_view bytes, const ReadOptions& options = {}) {
  Result<model::Model> result = read(bytes, options);
  EXPECT_TRUE(result) << (result ? "" : result.error().text());
  return result ? std::move(*result) : model::Model{};
}

Error read_bad(std::string_view bytes) {
  const Result<model::Model> result = read(bytes);
  EXPECT_FALSE(result);
  return result ? Error{} : result.error();
}

Vec3d corner(const model::Model& model, std::size_t body, std::size_t vertex) {
  const model::Body& placed = model.bodies.at(body);
  const model::Shape& shape = model.shapes.at(model::index(placed.shape));
  if (const auto* const lines = std::get_if<Polylines>(&shape))
    return placed.placement * lines->points.at(vertex);
  return placed.placement * std::get<TriangleMesh>(shape).vertices.at(vertex);
}

constexpr const char* kNode = R"("nodes":[{"mesh":0}])";

TEST(GltfReader, ReadsATriangleInMillimetresWithZUp) {
  const model::Model model = read_ok(triangle_glb(kNode));
  ASSERT_EQ(model.objects.size(), 1U);
  EXPECT_EQ(model.objects[0].name, "m") << "the mesh's name where the node has none";
  EXPECT_EQ(model.objects[0].id, "m");
  EXPECT_EQ(corner(model, 0, 1), (Vec3d{1000, 0, 0}));
  EXPECT_EQ(corner(model, 0, 2), (Vec3d{0, 0, 2000}));
  EXPECT_EQ(model.files[0].format, "GLB");
  EXPECT_EQ(model.files[0].unit, "m (stated)");
  EXPECT_EQ(model.files[0].up_axis, "y");
  EXPECT_EQ(model.files[0].precision_mm, 1000 * std::ldexp(1.0, -23)) << "float32 at 2 m";
}

TEST(GltfReader, LetsTheUserOverrideUnitAndUpAxis) {
  ReadOptions options;
  options.unit_mm = 1;
  options.up_axis = UpAxis::z;
  const model::Model model = read_ok(triangle_glb(kNode), options);
  EXPECT_EQ(corner(model, 0, 2), (Vec3d{0, 2, 0}));
  EXPECT_EQ(model.files[0].unit, "mm (given)");
}

TEST(GltfReader, NodesAboveGiveTheirAttributes) {
  const model::Model model = read_ok(triangle_glb(
      R"("nodes":[{"name":"deck","children":[1],"extras":{"area":7}},)"
      R"({"name":"pump","mesh":0,"children":[2],"extras":{"tag":"P-1"}},{"name":"bolt","mesh":0}])"));
  ASSERT_EQ(model.objects.size(), 2U);
  const model::Object& bolt = model.objects[1];
  EXPECT_EQ(*model.stated(bolt, "area").attributes, (model::Attributes{{"area", "7"}}));
  EXPECT_EQ(*model.stated(bolt, "tag").attributes, (model::Attributes{{"tag", "P-1"}}));
  EXPECT_EQ(model.objects[0].attributes, (model::Attributes{{"tag", "P-1"}}));
  EXPECT_TRUE(bolt.attributes.empty());
}

TEST(GltfReader, FollowsTheHierarchy) {
  const model::Model model = read_ok(triangle_glb(
      R"("nodes":[{"name":"deck","children":[2,1],"translation":[10,0,0]},)"
      R"({"name":"pump","mesh":0,"rotation":[0,0.7071067811865476,0,0.7071067811865476],)"
      R"("scale":[2,2,2],"children":[3]},)"
      R"({"name":"plate","mesh":0,"matrix":[0,0,-1,0,0,1,0,0,1,0,0,0,0,5,0,1]},)"
      R"({"name":"bolt","mesh":0,"extras":{"id":"B-7","weight":1.5,"tag":{"no":"x\ny"},)"
      R"("attributes":{"material":"steel"}}}])"));
  ASSERT_EQ(model.objects.size(), 3U);
  EXPECT_EQ(model.objects[0].id, "deck/plate");
  EXPECT_EQ(model.objects[1].id, "deck/pump");
  EXPECT_EQ(model.objects[2].id, "B-7");
  const model::Group& below = model.groups.at(model::index(model.objects[2].parent));
  EXPECT_EQ(below.name, "pump");
  EXPECT_EQ(model.groups.at(model::index(below.parent)).name, "deck");
  EXPECT_EQ(model.objects[2].attributes,
            (model::Attributes{{"weight", "1.5"}, {"tag.no", "x\ny"}, {"material", "steel"}}));
  // Both turns take file x to -z, which is model y.
  const Vec3d plate = corner(model, 0, 1), pump = corner(model, 1, 1), bolt = corner(model, 2, 1);
  EXPECT_EQ(plate, (Vec3d{10000, 1000, 5000}));
  EXPECT_NEAR(pump.x, 10000, 1e-9);
  EXPECT_NEAR(pump.y, 2000, 1e-9);
  EXPECT_NEAR(bolt.y, 2000, 1e-9);
  EXPECT_EQ(model.shapes.size(), 1U) << "one shape for one mesh";
}

TEST(GltfReader, StatesWhichIdsAreOnlyPositions) {
  const model::Model model = read_ok(
      triangle_glb(R"("nodes":[{"name":"deck","children":[1,2]},{"mesh":0},{"children":[3,4]},)"
                   R"({"name":"plate","mesh":0},{"name":"bolt","mesh":0,"extras":{"id":"B-7"}},)"
                   R"({"name":"pump","mesh":0}])"));
  std::vector<std::string> positions, lasting;
  for (const model::Object& o : model.objects)
    (o.positional_id ? positions : lasting).push_back(o.id);
  EXPECT_EQ(positions, (std::vector<std::string>{"deck/node 2/plate"}));
  EXPECT_EQ(lasting, (std::vector<std::string>{"deck/m", "B-7", "pump"}));
}

TEST(GltfReader, TakesExtrasOfAnyType) {
  for (const char* extras : {"[1]", "[1,2,3]", "[]", "{}", "7", "null", R"("text")",
                             R"({"id":[1]})", R"({"instances":{"a":1},"attributes":[1]})"}) {
    const model::Model model =
        read_ok(triangle_glb(fmt::format(R"("nodes":[{{"mesh":0,"extras":{}}}])", extras)));
    EXPECT_EQ(model.objects.size(), 1U) << extras;
  }
}

TEST(GltfReader, ChoosesTheScene) {
  const std::string nodes = R"("nodes":[{"name":"a","mesh":0},{"name":"b","mesh":0}])";
  EXPECT_EQ(read_ok(triangle_glb(nodes)).objects.size(), 2U);
  const std::string scenes = R"(,"scenes":[{"nodes":[0]},{"nodes":[1]}])";
  EXPECT_EQ(read_ok(triangle_glb(nodes, scenes)).objects.at(0).name, "a");
  EXPECT_EQ(read_ok(triangle_glb(nodes, scenes + R"(,"scene":1)")).objects.at(0).name, "b");
}

TEST(GltfReader, RefusesBrokenHierarchies) {
  const auto place = [](const std::string& nodes, const std::string& extra = {}) {
    return read_bad(triangle_glb(nodes, extra)).where;
  };
  EXPECT_EQ(place(R"("nodes":[{"mesh":0,"children":[1]},{"children":[0]}])"),
            "some/model.glb, /nodes/0");
  EXPECT_EQ(place(R"("nodes":[{"mesh":0},{"children":[1]}])"), "some/model.glb, /nodes/1");
  EXPECT_EQ(place(R"("nodes":[{"children":[2]},{"children":[2]},{"mesh":0}])"),
            "some/model.glb, /nodes/1/children");
  EXPECT_EQ(place(R"("nodes":[{"children":[1,1]},{"mesh":0}])"),
            "some/model.glb, /nodes/0/children");
  EXPECT_EQ(place(R"("nodes":[{"mesh":0,"children":[9]}])"), "some/model.glb, /nodes/0/children");
  EXPECT_EQ(place(R"("nodes":[{"mesh":0}])", R"(,"scenes":[{"nodes":[1]}])"),
            "some/model.glb, /scenes/0/nodes");
  EXPECT_EQ(place(R"("nodes":[{"mesh":0}])", R"(,"scenes":[{"nodes":[0,0]}])"),
            "some/model.glb, /scenes/0/nodes");
  EXPECT_EQ(place(R"("nodes":[{"mesh":0}])", R"(,"scene":3,"scenes":[{"nodes":[0]}])"),
            "some/model.glb, /scene");
  std::string chain = R"("nodes":[)";
  for (int i = 0; i < 2000; ++i) chain += fmt::format(R"({{"children":[{}]}},)", i + 1);
  EXPECT_NE(place(chain + R"({"mesh":0}])"), "");
}

TEST(GltfReader, SkipsDamagedObjectsAndKeepsTheOthers) {
  const auto damaged = [](const std::string& node) {
    const model::Model model =
        read_ok(triangle_glb(R"("nodes":[{"name":"good","mesh":0},)" + node + "]"));
    EXPECT_EQ(model.objects.size(), 2U) << "the damaged one is listed, without bodies: " << node;
    EXPECT_FALSE(model.objects.at(0).incomplete) << node;
    EXPECT_TRUE(model.objects.at(1).incomplete && model.objects.at(1).body_count == 0) << node;
    EXPECT_EQ(model.diagnostics.count("gltf-damaged-object"), 1U) << node;
    return model.diagnostics.kept().empty() ? "" : model.diagnostics.kept()[0].where;
  };
  EXPECT_EQ(damaged(R"({"mesh":1})"), "some/model.glb, /nodes/1/mesh");
  EXPECT_EQ(damaged(R"({"mesh":0,"matrix":[1,2,3]})"), "some/model.glb, /nodes/1");
  EXPECT_EQ(damaged(R"({"mesh":0,"matrix":[1,0,0,1,0,1,0,0,0,0,1,0,0,0,0,1]})"),
            "some/model.glb, /nodes/1");
  EXPECT_EQ(damaged(R"({"mesh":0,"rotation":[0,0,0,0]})"), "some/model.glb, /nodes/1");
  EXPECT_EQ(damaged(R"({"mesh":0,"translation":[1e999,0,0]})"), "some/model.glb, /nodes/1");
  EXPECT_EQ(damaged(R"({"scale":[1,"x",1],"children":[2]},{"mesh":0})"),
            "some/model.glb, /nodes/1");
  EXPECT_EQ(damaged(R"({"mesh":0,"scale":[1e308,1e308,1e308]})"), "some/model.glb, /meshes/0");
}

/// A document of one mesh whose parts a test replaces.
struct Parts {
  std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0};
  std::string views;
  std::string accessors;
  std::string primitive = R"("attributes":{"POSITION":0})";
  std::string more;
  std::string binary_tail;
  std::string head;

  [[nodiscard]] std::string build() const {
    const std::string binary = bytes_of(positions) + binary_tail;
    return glb(fmt::format(R"({{"asset":{{"version":"2.0"}},{}"buffers":[{{"byteLength":{}}}],)"
                           R"("bufferViews":[{{"buffer":0,"byteLength":{}}}{}],)"
                           R"("accessors":[{{"bufferView":0,"componentType":5126,"count":{},)"
                           R"("type":"VEC3"}}{}],"meshes":[{{"primitives":[{{{}}}{}]}}],)"
                           R"("nodes":[{{"name":"n","mesh":0}}]}})",
                           head, binary.size(), bytes_of(positions).size(), views,
                           positions.size() / 3, accessors, primitive, more),
               binary);
  }
};

TEST(GltfReader, ReadsEveryPrimitiveMode) {
  const auto with_mode = [](int mode) {
    Parts parts;
    parts.primitive += fmt::format(R"(,"mode":{})", mode);
    return parts.build();
  };
  const auto triangles = [&](int mode) {
    return std::get<TriangleMesh>(read_ok(with_mode(mode)).shapes.at(0)).triangles;
  };
  const auto chains = [&](int mode) {
    return std::get<Polylines>(read_ok(with_mode(mode)).shapes.at(0));
  };
  EXPECT_EQ(read_bad(with_mode(0)).where, "some/model.glb, /meshes/0");
  EXPECT_EQ(chains(1).first, (std::vector<std::uint32_t>{0, 2, 4})) << "the fifth is left over";
  EXPECT_EQ(chains(2).points.size(), 6U);
  EXPECT_EQ(chains(2).points.front(), chains(2).points.back());
  EXPECT_EQ(chains(3).first, (std::vector<std::uint32_t>{0, 5}));
  EXPECT_EQ(triangles(4).size(), 1U);
  EXPECT_EQ(triangles(5), (std::vector<geometry::Triangle>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
  EXPECT_EQ(triangles(6), (std::vector<geometry::Triangle>{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
  EXPECT_FALSE(read(with_mode(7)));
}

/// Of a strip, a fan and a chain as of plain triangles only what uses the bad vertex goes.
TEST(GltfReader, KeepsAnObjectWithoutTheFacesThatCannotBeRead) {
  const auto without_vertex = [](int mode, std::size_t vertex) {
    Parts parts;
    parts.positions.at(3 * vertex + 1) = NAN;
    parts.primitive += fmt::format(R"(,"mode":{})", mode);
    model::Model model = read_ok(parts.build());
    EXPECT_TRUE(model.objects.at(0).incomplete && model.diagnostics.skipped() == 1) << mode;
    return model;
  };
  const model::Model strip = without_vertex(5, 4);
  EXPECT_EQ(std::get<TriangleMesh>(strip.shapes.at(0)).triangles,
            (std::vector<geometry::Triangle>{{0, 1, 2}, {1, 3, 2}}));
  EXPECT_EQ(strip.diagnostics.kept().at(0).message,
            "object 'n' is kept without 1 face: vertex 4 is not finite");
  EXPECT_EQ(strip.diagnostics.kept().at(0).where, "some/model.glb, /accessors/0");
  EXPECT_EQ(std::get<TriangleMesh>(without_vertex(6, 4).shapes.at(0)).triangles,
            (std::vector<geometry::Triangle>{{1, 2, 0}, {2, 3, 0}}));
  EXPECT_EQ(std::get<Polylines>(without_vertex(3, 2).shapes.at(0)).first,
            (std::vector<std::uint32_t>{0, 2, 4}));
}

TEST(GltfReader, KeepsAnObjectWithoutTheFacesWhoseIndicesAreWrong) {
  Parts parts;
  parts.binary_tail = bytes_of(std::vector<std::uint8_t>{0, 1, 2, 0, 3, 200, 1, 3, 2});
  parts.views = R"(,{"buffer":0,"byteOffset":60,"byteLength":9})";
  parts.accessors = R"(,{"bufferView":1,"componentType":5121,"count":9,"type":"SCALAR"})";
  parts.primitive += R"(,"indices":1)";
  const model::Model model = read_ok(parts.build());
  EXPECT_EQ(std::get<TriangleMesh>(model.shapes.at(0)).triangles.at(1),
            (geometry::Triangle{1, 3, 2}));
  EXPECT_TRUE(model.objects.at(0).incomplete);
  EXPECT_EQ(model.diagnostics.kept().at(0).message,
            "object 'n' is kept without 1 face: there is no vertex 200, only 5 of them");
  parts.binary_tail = bytes_of(std::vector<std::uint8_t>(9, 99));
  EXPECT_EQ(read_bad(parts.build()).where, "some/model.glb, /meshes/0/primitives/0/indices");
}

TEST(GltfReader, JoinsSegmentsThatGoOn) {
  Parts parts;
  parts.binary_tail = bytes_of(std::vector<std::uint8_t>{0, 1, 1, 2, 3, 4});
  parts.views = R"(,{"buffer":0,"byteOffset":60,"byteLength":6})";
  parts.accessors = R"(,{"bufferView":1,"componentType":5121,"count":6,"type":"SCALAR"})";
  parts.primitive += R"(,"mode":1,"indices":1)";
  const model::Model model = read_ok(parts.build());
  EXPECT_EQ(std::get<Polylines>(model.shapes.at(0)).first, (std::vector<std::uint32_t>{0, 3, 5}));
}

TEST(GltfReader, ReadsInterleavedAndQuantisedPositions) {
  // Two vertices of one stride each: three int16 positions, then something else.
  Parts parts;
  parts.binary_tail =
      bytes_of(std::vector<std::int16_t>{32767, 0, 0, 99, 0, -32768, 0, 99, 0, 0, 16384, 99});
  parts.views = R"(,{"buffer":0,"byteOffset":60,"byteLength":24,"byteStride":8})";
  parts.accessors =
      R"(,{"bufferView":1,"componentType":5122,"normalized":true,"count":3,"type":"VEC3"})";
  parts.primitive = R"("attributes":{"POSITION":1})";
  parts.head = R"("extensionsRequired":["KHR_mesh_quantization"],)";
  const model::Model model = read_ok(parts.build());
  EXPECT_EQ(corner(model, 0, 0), (Vec3d{1000, 0, 0}));
  EXPECT_EQ(corner(model, 0, 1), (Vec3d{0, 0, -1000})) << "normalised values end at -1";
  EXPECT_NEAR(corner(model, 0, 2).y, -500.0152, 1e-3);
  EXPECT_NEAR(model.files[0].precision_mm, 1000.0 / 32767 / 2, 1e-9) << "coarser than float32";
}

TEST(GltfReader, ReadsSparseAccessors) {
  Parts parts;
  parts.binary_tail =
      bytes_of(std::vector<std::uint16_t>{1, 2}) + bytes_of(std::vector<float>{7, 7, 7, 8, 8, 8});
  parts.views = R"(,{"buffer":0,"byteOffset":60,"byteLength":4},)"
                R"({"buffer":0,"byteOffset":64,"byteLength":24})";
  const std::string sparse = R"("sparse":{"count":2,"indices":{"bufferView":1,)"
                             R"("componentType":5123},"values":{"bufferView":2}})";
  parts.accessors = R"(,{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",)" + sparse +
                    R"(},{"componentType":5126,"count":3,"type":"VEC3",)" + sparse + "}";
  for (const char* position : {"1", "2"}) {
    parts.primitive = fmt::format(R"("attributes":{{"POSITION":{}}})", position);
    const model::Model model = read_ok(parts.build());
    EXPECT_EQ(corner(model, 0, 0), (Vec3d{0, 0, 0}));
    EXPECT_EQ(corner(model, 0, 1), (Vec3d{7000, -7000, 7000}));
    EXPECT_EQ(corner(model, 0, 2), (Vec3d{8000, -8000, 8000}));
  }
  parts.binary_tail[0] = 9;
  EXPECT_EQ(read_bad(parts.build()).where, "some/model.glb, /accessors/2/sparse");
}

TEST(GltfReader, RefusesDataOutsideItsBounds) {
  const auto place_of = [](const auto& change) {
    Parts parts;
    parts.binary_tail = bytes_of(std::vector<std::uint32_t>{0, 1, 2});
    parts.views = R"(,{"buffer":0,"byteOffset":60,"byteLength":12})";
    parts.accessors = R"(,{"bufferView":1,"componentType":5125,"count":3,"type":"SCALAR"})";
    parts.primitive += R"(,"indices":1)";
    change(parts);
    return read_bad(parts.build()).where;
  };
  EXPECT_EQ(place_of([](Parts& p) { p.binary_tail[4] = 77; }),
            "some/model.glb, /meshes/0/primitives/0/indices");
  EXPECT_EQ(place_of([](Parts& p) { p.positions[4] = std::numeric_limits<float>::quiet_NaN(); }),
            "some/model.glb, /accessors/0");
  EXPECT_EQ(place_of([](Parts& p) {
              p.accessors = R"(,{"bufferView":1,"componentType":5125,"count":4,"type":"SCALAR"})";
            }),
            "some/model.glb, /accessors/1");
  EXPECT_EQ(
      place_of([](Parts& p) {
        p.accessors =
            R"(,{"bufferView":1,"byteOffset":4,"componentType":5125,"count":3,"type":"SCALAR"})";
      }),
      "some/model.glb, /accessors/1");
  EXPECT_EQ(place_of([](Parts& p) {
              p.accessors = R"(,{"bufferView":7,"componentType":5125,"count":3,"type":"SCALAR"})";
            }),
            "some/model.glb, /bufferViews/7");
  EXPECT_EQ(
      place_of([](Parts& p) { p.views = R"(,{"buffer":0,"byteOffset":64,"byteLength":12})"; }),
      "some/model.glb, /bufferViews/1");
  EXPECT_EQ(place_of([](Parts& p) {
              p.views =
                  R"(,{"buffer":0,"byteOffset":9007199254740992,"byteLength":9007199254740992})";
            }),
            "some/model.glb, /bufferViews/1");
  EXPECT_EQ(place_of([](Parts& p) {
              p.views = R"(,{"buffer":0,"byteOffset":60,"byteLength":12,"byteStride":2})";
            }),
            "some/model.glb, /accessors/1");
  EXPECT_EQ(place_of([](Parts& p) {
              p.accessors = R"(,{"componentType":5125,"count":900000000,"type":"SCALAR"})";
            }),
            "some/model.glb")
      << "more corners than the file could hold";
  EXPECT_EQ(place_of([](Parts& p) { p.primitive = R"("attributes":{"POSITION":1})"; }),
            "some/model.glb, /accessors/1");
}

TEST(GltfReader, RefusesAFileThatMultipliesItsData) {
  // A hundred thousand meshes of the same hundred thousand corners would be terabytes.
  std::string meshes =
      R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":400000}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":400000}],"accessors":[)"
      R"({"bufferView":0,"componentType":5126,"count":33333,"type":"VEC3"},)"
      R"({"bufferView":0,"componentType":5121,"count":400000,"type":"SCALAR"}],"meshes":[)";
  std::string nodes = R"("nodes":[)";
  for (int i = 0; i < 100000; ++i) {
    meshes += R"({"primitives":[{"attributes":{"POSITION":0},"indices":1}]},)";
    nodes += fmt::format(R"({{"mesh":{}}},)", i);
  }
  meshes.back() = ']';
  nodes.back() = ']';
  const Error error = read_bad(glb(meshes + "," + nodes + "}", std::string(400000, '\0')));
  EXPECT_NE(error.message.find("so often"), std::string::npos);
}

TEST(GltfReader, PlacesInstances) {
  const std::string tail = bytes_of(std::vector<float>{1, 0, 0, 0, 2, 0}) +
                           bytes_of(std::vector<float>{1, 1, 1, 2, 2, 2});
  const auto build = [&](const std::string& extras) {
    const std::string binary = bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 2, 0}) + tail;
    return glb(R"({"asset":{"version":"2.0"},"extensionsRequired":["EXT_mesh_gpu_instancing"],)"
               R"("buffers":[{"byteLength":84}],"bufferViews":[{"buffer":0,"byteLength":36},)"
               R"({"buffer":0,"byteOffset":36,"byteLength":24},)"
               R"({"buffer":0,"byteOffset":60,"byteLength":24}],)"
               R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
               R"({"bufferView":1,"componentType":5126,"count":2,"type":"VEC3"},)"
               R"({"bufferView":2,"componentType":5126,"count":2,"type":"VEC3"}],)"
               R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
               R"("nodes":[{"name":"bolts","mesh":0,"translation":[10,0,0],)" +
                   extras +
                   R"("extensions":{"EXT_mesh_gpu_instancing":{"attributes":)"
                   R"({"TRANSLATION":1,"SCALE":2}}}}]})",
               binary);
  };
  const model::Model one = read_ok(build(""));
  ASSERT_EQ(one.objects.size(), 2U);
  EXPECT_EQ(one.objects[1].id, "bolts/instance 1");
  EXPECT_EQ(corner(one, 0, 1), (Vec3d{12000, 0, 0}));
  EXPECT_EQ(corner(one, 1, 1), (Vec3d{12000, 0, 2000}));
  EXPECT_EQ(one.shapes.size(), 1U);

  const model::Model named =
      read_ok(build(R"("extras":{"instances":["left",{"id":"B2","name":"right"}]},)"));
  ASSERT_EQ(named.objects.size(), 2U);
  EXPECT_EQ(named.objects[0].id, "bolts/left");
  EXPECT_EQ(named.objects[1].id, "B2");
  EXPECT_EQ(named.objects[1].name, "right");
  EXPECT_EQ(named.objects[1].first_body, 1U);
  EXPECT_FALSE(named.objects[0].positional_id || named.objects[1].positional_id);
  const model::Model half = read_ok(build(R"("extras":{"instances":["left",{}]},)"));
  EXPECT_EQ(half.objects.at(1).id, "bolts/instance 1");
  EXPECT_TRUE(half.objects[1].positional_id);
  EXPECT_FALSE(half.objects[0].positional_id);
}

TEST(GltfReader, TakesColoursOfMaterials) {
  Parts parts;
  parts.head = R"("materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0.21404114,0,0.5]}},)"
               R"({"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[0,0,1,0.5]}}],)";
  parts.primitive = R"("attributes":{"POSITION":0},"material":0)";
  parts.more =
      R"(,{"attributes":{"POSITION":0},"material":1},{"attributes":{"POSITION":0},"mode":5})";
  const model::Model model = read_ok(parts.build());
  ASSERT_EQ(model.bodies.size(), 2U) << "opaque and transparent apart";
  EXPECT_EQ(model.bodies[0].color, model::Color{}) << "of most triangles: the strip's";
  EXPECT_EQ(std::get<TriangleMesh>(model.shapes[0]).triangles.size(), 4U);
  EXPECT_EQ(model.bodies[1].color, (model::Color{0, 0, 255, 128}));
  parts.more.clear();
  EXPECT_EQ(read_ok(parts.build()).bodies[0].color, (model::Color{255, 127, 0, 255}));
}

TEST(GltfReader, ReportsNodesInOtherScenes) {
  constexpr const char* kTwo =
      R"("nodes":[{"name":"a","mesh":0},{"name":"b","mesh":0},{"name":"c"}])";
  const model::Model one =
      read_ok(triangle_glb(kTwo, R"(,"scene":1,"scenes":[{"nodes":[0]},{"nodes":[1]}])"));
  ASSERT_EQ(one.objects.size(), 1U);
  EXPECT_EQ(one.objects[0].name, "b");
  EXPECT_EQ(one.diagnostics.count("gltf-other-scene"), 1U);
  const model::Model both = read_ok(triangle_glb(kTwo, R"(,"scenes":[{"nodes":[0,1]}])"));
  EXPECT_TRUE(both.diagnostics.kept().empty()) << "a node without a mesh is nobody's loss";
}

TEST(GltfReader, ReportsMorphTargetsThatAreApplied) {
  const auto reported = [](const char* node) {
    return read_ok(triangle_glb(fmt::format(R"("nodes":[{{"mesh":0{}}}])", node)))
        .diagnostics.count("gltf-morph");
  };
  EXPECT_EQ(reported(R"(,"weights":[0,0.5])"), 1U);
  EXPECT_EQ(reported(R"(,"weights":[0,0.0])"), 0U);
  EXPECT_EQ(reported(""), 0U);
  Parts parts;
  parts.more = R"(],"weights":[0.5],"extras":[1)";
  EXPECT_EQ(read_ok(parts.build()).diagnostics.count("gltf-morph"), 1U);
}

TEST(GltfReader, KeepsASolidWithATransparentFaceInOnePiece) {
  const std::string binary =
      bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) +
      bytes_of(std::vector<std::uint16_t>{0, 1, 3, 1, 2, 3, 2, 0, 3, 0, 2, 1});
  const model::Model model = read_ok(glb(
      R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":72}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":48},)"
      R"({"buffer":0,"byteOffset":48,"byteLength":24}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
      R"({"bufferView":1,"componentType":5123,"count":9,"type":"SCALAR"},)"
      R"({"bufferView":1,"byteOffset":18,"componentType":5123,"count":3,"type":"SCALAR"}],)"
      R"("materials":[{"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[0,0,1,0.5]}}],)"
      R"("meshes":[{"name":"m","primitives":[{"attributes":{"POSITION":0},"indices":1},)"
      R"({"attributes":{"POSITION":0},"indices":2,"material":0}]}],"nodes":[{"mesh":0}]})",
      binary));
  ASSERT_EQ(model.bodies.size(), 1U);
  EXPECT_EQ(std::get<TriangleMesh>(model.shapes[0]).triangles.size(), 4U);
  EXPECT_EQ(model.bodies[0].color, model::Color{});
  EXPECT_EQ(model.diagnostics.count("mesh-part-transparent"), 1U);
}

TEST(GltfReader, NamesExtensionsThatItDoesNotRead) {
  for (const char* name : {"KHR_draco_mesh_compression", "ACME_compression"}) {
    const Error error =
        read_bad(triangle_glb(kNode, fmt::format(R"(,"extensionsRequired":["{}"])", name)));
    EXPECT_NE(error.message.find(name), std::string::npos);
    EXPECT_NE(error.mend.find("without mesh compression"), std::string::npos);
  }
  EXPECT_FALSE(read(triangle_glb(kNode, R"(,"extensionsRequired":["ACME_magic"])")));
  EXPECT_TRUE(read(triangle_glb(kNode, R"(,"extensionsRequired":["KHR_texture_transform"])")));
}

TEST(GltfReader, ReadsBuffersBesideAndWithinTheFile) {
  const test::TemporaryFolder folder;
  const std::string binary = bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 2, 0});
  std::filesystem::create_directory(folder.path() / "inner");
  (void)folder.write("data file.bin", binary);
  (void)folder.write("inner/x.bin", binary);
  const auto document = [&](const std::string& uri) {
    return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":")" + uri +
           R"("}],"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,)"
           R"("componentType":5126,"count":3,"type":"VEC3"}],)"
           R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}]})";
  };
  const auto try_uri = [&](const std::string& uri) {
    return read(document(uri), {}, folder.path() / "inner" / ".." / "x.gltf");
  };
  EXPECT_TRUE(try_uri("data%20file.bin"));
  EXPECT_TRUE(try_uri("inner/x.bin"));
  EXPECT_TRUE(
      try_uri("data:application/octet-stream;base64,"
              "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAAAA"));
  EXPECT_TRUE(try_uri("data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAAAA"));
  EXPECT_FALSE(try_uri("data:;base64,AAA"));
  EXPECT_FALSE(try_uri("data:;base64,!!!!"));
  EXPECT_FALSE(try_uri("missing.bin"));
  std::filesystem::create_symlink("/etc/passwd", folder.path() / "link.bin");
  for (const std::string uri :
       {"../x.bin", "inner/../../x.bin", "/etc/passwd", "file:///etc/passwd", "link.bin", "",
        "%2e%2e/x.bin", "..\\\\x.bin", "C:\\\\x.bin", "https://example.org/x.bin"}) {
    const Result<model::Model> result = try_uri(uri);
    ASSERT_FALSE(result) << uri;
    EXPECT_EQ(result.error().code, ErrorCode::input);
  }
}

TEST(GltfReader, DecodesBase64) {
  const auto text = [](std::string_view raw) {
    const auto bytes = gltf::decode_base64(raw);
    return bytes ? std::string(as_text(*bytes)) : "bad";
  };
  EXPECT_EQ(text(""), "");
  EXPECT_EQ(text("TQ=="), "M");
  EXPECT_EQ(text("TWE="), "Ma");
  EXPECT_EQ(text("TWFu"), "Man");
  EXPECT_EQ(text("TWFuTQ"), "ManM");
  EXPECT_EQ(text("T"), "bad");
  EXPECT_EQ(text("TW u"), "bad");
}

TEST(GltfReader, RefusesDamagedContainers) {
  const std::string good = triangle_glb(kNode);
  for (std::size_t length = 4; length < good.size(); ++length)
    EXPECT_FALSE(read(std::string_view(good).substr(0, length))) << length;
  std::string old = good;
  old[4] = 1;
  EXPECT_NE(read_bad(old).message.find("version 1"), std::string::npos);
  EXPECT_EQ(read_bad(glb(R"({"asset":{"version":"2.0"},)")).where,
            "some/model.glb, byte 28 of its JSON");
  EXPECT_NE(read_bad(glb(R"({"asset":{"version":"1.0"}})")).mend.find("2.0"), std::string::npos);
  EXPECT_FALSE(read(glb("[]")));
  EXPECT_FALSE(read(glb(R"({"asset":{"version":"2.0"},"scene":0})")));
}

TEST(GltfReader, GivesBackWhatTheWriterWrote) {
  const model::Model sample = test::sample_model();
  for (const bool z_up : {false, true}) {
    const test::TemporaryFolder folder;
    WriteOptions options;
    options.millimetres_z_up = z_up;
    ASSERT_TRUE(write_glb(sample, folder.path() / "x.glb", options, {}));
    const Result<FileContent> content = FileContent::read(folder.path() / "x.glb");
    ASSERT_TRUE(content);
    const model::Model back = read_ok(as_text(content->bytes()));
    EXPECT_EQ(back.files[0].unit, z_up ? "mm (stated)" : "m (stated)");
    ASSERT_EQ(back.objects.size(), sample.objects.size());
    for (const model::Object& object : sample.objects) {
      const auto found = std::find_if(back.objects.begin(), back.objects.end(),
                                      [&](const model::Object& o) { return o.id == object.id; });
      ASSERT_NE(found, back.objects.end()) << object.id;
      EXPECT_EQ(found->name, object.name);
      EXPECT_EQ(back.path(*found), sample.path(object));
      EXPECT_EQ(back.bodies[found->first_body].color, sample.bodies[object.first_body].color);
      const std::size_t vertices = object.id == "five" ? 5 : 8;
      for (std::size_t v = 0; v < vertices; ++v) {
        const Vec3d was = corner(sample, object.first_body, v),
                    is = corner(back, found->first_body, v);
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(is[k], was[k], z_up ? 0 : 1e-4) << object.id;
      }
    }
  }
}

TEST(GltfReader, RecognisesItsContent) {
  const auto sureness = [](std::string_view bytes, const char* path) {
    return make_gltf_reader()->recognise({path, std::as_bytes(std::span(bytes))});
  };
  EXPECT_EQ(sureness(triangle_glb(kNode), "x.bin"), 100);
  EXPECT_GT(sureness("  {\"asset\":{\"version\":\"2.0\"}}", "x.json"), 50);
  EXPECT_GT(sureness("{}", "x.gltf"), 90);
  EXPECT_EQ(sureness("v 0 0 0\n", "x.obj"), 0);
}

}  // namespace
}  // namespace strake::io
