// SPDX-License-Identifier: Apache-2.0
// Small files that claim or request much: each is refused with a reason or read in time and memory
// that its size justifies. Bounds of CPU time are ten times and more what is needed, and a small
// part of what the file would take from a reader that believes it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "strake/io/reader.hpp"
#include "strake/parallel/report.hpp"
#include "support/gltf_files.hpp"
#include "support/io_files.hpp"
#include "support/rvm_writer.hpp"

namespace strake::io {
namespace {

using test::bytes_of;
using test::glb;

constexpr double kPatience = 20;  // CPU seconds, sanitizers included

struct Timed {
  Result<model::Model> model;
  double seconds = 0;
};

Timed read(const Reader& reader, std::string_view bytes) {
  const double start = parallel::thread_cpu_s();
  Result<model::Model> model = test::read_bytes(reader, bytes, "hostile", {});
  return {std::move(model), parallel::thread_cpu_s() - start};
}

Timed read_glb(const std::string& bytes) { return read(*make_gltf_reader(), bytes); }

std::string reason(const Timed& timed) {
  EXPECT_FALSE(timed.model);
  EXPECT_LT(timed.seconds, kPatience);
  return timed.model ? "" : timed.model.error().message;
}

/// `count` times the text, with commas between.
std::string repeated(const std::string& text, std::size_t count) {
  std::string all;
  for (std::size_t i = 0; i < count; ++i) all.append(i == 0 ? "" : ",").append(text);
  return all;
}

/// One triangle mesh without indices; `mesh` and `accessor` are further members of those.
std::string hostile_document(const std::string& nodes, const std::string& mesh = {},
                             const std::string& accessor = {}, std::size_t primitives = 1) {
  return glb(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36}],)"
             R"("bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{)" +
                 accessor + R"("bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)" +
                 R"("meshes":[{)" + mesh + R"("primitives":[)" +
                 repeated(R"({"attributes":{"POSITION":0}})", primitives) + R"(]}],"nodes":[)" +
                 nodes + "]}",
             bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 2, 0}));
}

TEST(HostileGltf, ManyNodesThatStateNothing) {
  EXPECT_NE(reason(read_glb(hostile_document(repeated("{}", 2'000'000)))).find("more nodes"),
            std::string::npos);
  EXPECT_TRUE(read_glb(hostile_document(R"({"mesh":0},)" + repeated("{}", 100'000))).model);
}

TEST(HostileGltf, LeavesBelowAChainOfGroups) {
  constexpr std::size_t kChain = 900, kLeaves = 100'000;
  std::string nodes, children;
  for (std::size_t i = 1; i <= kChain; ++i)
    nodes += fmt::format(R"({{"name":"level {}","children":[{}]}},)", i, i);
  for (std::size_t i = 0; i < kLeaves; ++i)
    children += fmt::format("{}{}", i == 0 ? "" : ",", kChain + 1 + i);
  nodes += R"({"name":"last","children":[)" + children + "]}," +
           repeated(R"({"mesh":0,"name":"leaf"})", kLeaves);
  const std::string bytes = hostile_document(nodes);
  const Timed timed = read_glb(bytes);
  ASSERT_TRUE(timed.model) << timed.model.error().text();
  EXPECT_LT(timed.seconds, kPatience);
  ASSERT_EQ(timed.model->objects.size(), kLeaves);
  std::size_t id_bytes = 0;
  for (const model::Object& object : timed.model->objects) id_bytes += object.id.size();
  EXPECT_LT(id_bytes, 40 * bytes.size());
  EXPECT_TRUE(timed.model->objects[0].id.ends_with("/leaf")) << timed.model->objects[0].id;
}

TEST(HostileGltf, LongPathsStayApart) {
  const std::string long_name(300, 'x');
  const auto ids = [&](const std::string& outer, const std::string& leaf) {
    const Timed timed = read_glb(hostile_document(fmt::format(
        R"({{"name":"{}","children":[1]}},{{"name":"{}","children":[2]}},{{"mesh":0,"name":"{}"}})",
        outer, long_name, leaf)));
    return timed.model ? timed.model->objects.at(0).id : "";
  };
  EXPECT_EQ(ids("a", "leaf"), ids("a", "leaf"));
  EXPECT_NE(ids("a", "leaf"), ids("b", "leaf"));
  EXPECT_NE(ids("a", "leaf"), ids("a", "leaf2"));
  EXPECT_LE(ids("a", long_name).size(), 256U);
}

TEST(HostileGltf, MembersThatAreNoneOfOurs) {
  std::string junk;
  for (int i = 0; i < 100'000; ++i) junk += fmt::format(R"("j{}":0,)", i);
  // Nameless nodes ask the mesh for its name, primitives ask the accessor for everything.
  for (const std::string& bytes : {hostile_document(repeated(R"({"mesh":0})", 100'000), junk),
                                   hostile_document(R"({"mesh":0})", "", junk, 100'000)}) {
    const Timed timed = read_glb(bytes);
    ASSERT_TRUE(timed.model) << timed.model.error().text();
    EXPECT_LT(timed.seconds, kPatience);
  }
}

TEST(HostileGltf, SparseVerticesOfManyPrimitives) {
  const std::string positions(1'200'000, '\0');
  const std::string bytes = glb(
      R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":1200000}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":1200000}],"accessors":[)"
      R"({"bufferView":0,"componentType":5126,"count":100000,"type":"VEC3","sparse":{"count":1,)"
      R"("indices":{"bufferView":0,"componentType":5125},"values":{"bufferView":0}}},)"
      R"({"bufferView":0,"componentType":5125,"count":3,"type":"SCALAR"}],)"
      R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[)" +
          repeated(R"({"attributes":{"POSITION":0},"indices":1})", 30'000) + "]}]}",
      positions);
  EXPECT_NE(reason(read_glb(bytes)).find("so often"), std::string::npos);
}

/// Nodes that are instanced `count` times each by one accessor.
std::string instancing(std::size_t nodes, std::size_t count, std::size_t stated_count,
                       const std::string& extras = {}) {
  const std::string offsets(3 * count, '\1');
  return glb(
      fmt::format(
          R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{}}}],"bufferViews":[)"
          R"({{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":{}}}],)"
          R"("accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}},)"
          R"({{"bufferView":1,"componentType":5120,"count":{},"type":"VEC3"}}],)"
          R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],"nodes":[)",
          36 + offsets.size(), offsets.size(), stated_count) +
          repeated(R"({"mesh":0,)" + extras +
                       R"("extensions":{"EXT_mesh_gpu_instancing":{"attributes":)"
                       R"({"TRANSLATION":1}}}})",
                   nodes) +
          "]}",
      bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 2, 0}) + offsets);
}

TEST(HostileGltf, InstancesBeyondAllMeasure) {
  EXPECT_NE(reason(read_glb(instancing(1, 10, 1'000'000'000))).find("so often"), std::string::npos);
  EXPECT_NE(reason(read_glb(instancing(1000, 10'000, 10'000))).find("so often"), std::string::npos);
  const Timed few = read_glb(instancing(3, 1000, 1000));
  ASSERT_TRUE(few.model) << few.model.error().text();
  EXPECT_EQ(few.model->bodies.size(), 3000U);
}

/// They stand once, in the group of the instances.
TEST(HostileGltf, AttributesOfNamedInstances) {
  std::string attributes;
  for (int i = 0; i < 1000; ++i)
    attributes += fmt::format(R"("k{}":"{}",)", i, std::string(50, 'v'));
  const std::string extras =
      R"("extras":{)" + attributes + R"("instances":[)" + repeated(R"("a")", 20'000) + "]},";
  const Timed many = read_glb(instancing(1, 20'000, 20'000, extras));
  ASSERT_TRUE(many.model) << many.model.error().text();
  ASSERT_EQ(many.model->objects.size(), 20'000U);
  EXPECT_TRUE(many.model->objects[0].attributes.empty());
  EXPECT_NE(many.model->stated(many.model->objects[0], "k999").attributes, nullptr);
}

TEST(HostileRvm, ChunksThatClaimAllThatFollows) {
  // Neither the address of the next chunk nor the counts of a facet group are to be believed.
  test::RvmWriter w;
  w.head().modl().cntb("/A").prim(9, {5});
  for (int i = 0; i < 100'000; ++i) w.facets({{}}, {}).set_word(80, 1'000'000).set_next(1);
  std::string bytes(reinterpret_cast<const char*>(w.bytes().data()), w.bytes().size());
  bytes.append(2'000'000, '\0');
  const Timed timed = read(*make_rvm_reader(), bytes);
  ASSERT_TRUE(timed.model) << timed.model.error().text();
  EXPECT_LT(timed.seconds, kPatience);
  EXPECT_EQ(timed.model->bodies.size(), 1U);
  EXPECT_EQ(timed.model->diagnostics.count("rvm-damaged-chunk"), 100'000U);
}

TEST(HostileObj, APolygonOfManyCorners) {
  // Corners on a circle of whole numbers would repeat; a parabola and its chord do not.
  std::string text, face = "f";
  constexpr int kCorners = 200'000;
  for (int i = 0; i < kCorners; ++i) {
    text += fmt::format("v {} {} 0\n", i, static_cast<double>(i) * i / kCorners);
    face += fmt::format(" {}", i + 1);
  }
  const Timed timed = read(*make_obj_reader(), text + face + "\n");
  ASSERT_TRUE(timed.model) << timed.model.error().text();
  EXPECT_LT(timed.seconds, kPatience);
  const auto& mesh = std::get<geometry::TriangleMesh>(timed.model->shapes.at(0));
  EXPECT_EQ(mesh.triangles.size(), kCorners - 2U);
}

/// What a hash that is the same in every run, of three doubles whose bits are multiplied and
/// folded, makes of a corner.
std::uint64_t fixed_hash(const std::array<float, 3>& corner) {
  std::uint64_t h = 0;
  for (const float c : corner) {
    h = (h ^ std::bit_cast<std::uint64_t>(static_cast<double>(c))) * 0x9E3779B97F4A7C15ULL;
    h ^= h >> 29U;
  }
  return h;
}

/// So many corners that meet in the last 18 bits of that hash.
std::vector<std::array<float, 3>> corners_that_meet(std::size_t count) {
  constexpr std::uint32_t kMask = (1U << 18U) - 1;
  std::vector<std::array<float, 3>> corners;
  for (std::uint32_t first = 0x3F800000U; corners.size() < count; ++first) {
    const auto x = std::bit_cast<float>(first);
    for (std::uint32_t low = 0; low <= kMask; ++low) {
      if ((fixed_hash({x, 0, std::bit_cast<float>(0x3F800000U ^ low)}) & kMask) != 0) continue;
      // Bits that are as far up do not reach the last ones.
      for (std::uint32_t high = 0; high < 1U << 14U && corners.size() < count; ++high) {
        const auto z = std::bit_cast<float>((high << 18U) | (low & kMask));
        if (std::isfinite(z) && (fixed_hash({x, 0, z}) & kMask) == 0) corners.push_back({x, 0, z});
      }
    }
  }
  return corners;
}

TEST(HostileRvm, CornersThatMeetInAHash) {
  std::vector<test::RvmWriter::FacetPolygon> polygons;
  const auto corners = corners_that_meet(300'000);
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    test::RvmWriter::Contour contour;
    for (std::size_t k = i; k < i + 3; ++k)
      contour.push_back({corners[k][0], corners[k][1], corners[k][2]});
    polygons.push_back({contour});
  }
  test::RvmWriter w;
  w.head().modl().cntb("/A").facets(polygons).cnte().finish();
  const std::string_view bytes(reinterpret_cast<const char*>(w.bytes().data()), w.bytes().size());
  const Timed timed = read(*make_rvm_reader(), bytes);
  ASSERT_TRUE(timed.model) << timed.model.error().text();
  EXPECT_LT(timed.seconds, kPatience);
  EXPECT_EQ(std::get<geometry::TriangleMesh>(timed.model->shapes.at(0)).vertices.size(),
            corners.size());
}

}  // namespace
}  // namespace strake::io
