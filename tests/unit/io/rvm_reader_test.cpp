// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "strake/io/reader.hpp"
#include "support/rvm_writer.hpp"

namespace strake::io {
namespace {

using geometry::Vec3d;
using test::RvmWriter;

Result<model::Model> read(const std::vector<std::byte>& bytes, const ReadOptions& options = {}) {
  return make_rvm_reader()->read({"test.rvm", bytes}, options, {});
}

Result<model::Model> read(const RvmWriter& writer, const ReadOptions& options = {}) {
  return read(writer.bytes(), options);
}

std::vector<std::byte> from_hex(std::string_view hex) {
  const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
  std::vector<std::byte> bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes.push_back(static_cast<std::byte>(digit(hex[i]) * 16 + digit(hex[i + 1])));
  return bytes;
}

/// A cylinder of radius 50 and height 400 along +X round (1, 2, 3) m, in group "/A", material 6.
constexpr std::string_view kCylinderFile =
    "000000480000004500000041000000440000004c000000010000000200000001"
    "7370656300000000000000016e6f7700000000016d65000000000004556e6963"
    "6f6465205554462d380000000000004d0000004f000000440000004c00000078"
    "00000001000000010000000150000000000000012f4d0000000000430000004e"
    "0000005400000042000000ac0000000100000002000000012f410000447a0000"
    "44fa0000453b8000000000060000005000000052000000490000004d0000011c"
    "0000000100000001000000080000000000000000ba83126f000000003a83126f"
    "000000003a83126f00000000000000003f8000004000000040400000c2480000"
    "c2480000c34800004248000042480000434800004248000043c8000000000043"
    "0000004e0000005400000045000001380000000100000002000000450000004e"
    "000000440000003a000001540000000100000001";

TEST(RvmReader, ReadsTheTestVector) {
  const auto bytes = from_hex(kCylinderFile);
  ASSERT_EQ(bytes.size(), 340U);
  EXPECT_EQ(make_rvm_reader()->recognise({"anything", bytes}), 100);
  const auto model = read(bytes);
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(model->files.at(0).format, "RVM 2");
  EXPECT_EQ(model->groups.size(), 1U);
  ASSERT_EQ(model->objects.size(), 1U);
  EXPECT_EQ(model->objects[0].name, "/A");
  EXPECT_EQ(model->objects[0].id, "/A");
  ASSERT_EQ(model->bodies.size(), 1U);
  const auto* cylinder =
      std::get_if<geometry::CylinderPrimitive>(&std::get<geometry::Primitive>(model->shapes.at(0)));
  ASSERT_NE(cylinder, nullptr);
  EXPECT_EQ(cylinder->radius, 50);
  EXPECT_EQ(cylinder->height, 400);
  const geometry::Placement& placement = model->bodies[0].placement;
  EXPECT_EQ(placement * Vec3d(0, 0, 200), Vec3d(1200, 2000, 3000));
  EXPECT_EQ(placement * Vec3d(50, 0, -200), Vec3d(800, 2000, 2950));
  EXPECT_EQ(placement * Vec3d(0, 50, 0), Vec3d(1000, 2050, 3000));
  EXPECT_EQ(model->bodies[0].color, (model::Color{0, 237, 237, 255}));
  EXPECT_TRUE(model->diagnostics.kept().empty());
}

/// All kinds once, each in a group of its own.
RvmWriter all_kinds(std::uint32_t version) {
  RvmWriter w;
  w.head(version >= 2 ? 2 : 1).modl();
  w.cntb("/ALL", version);
  const auto one = [&](std::string_view name, std::uint32_t kind,
                       std::initializer_list<float> parameters) {
    w.cntb(name, version).prim(kind, parameters).cnte(version);
  };
  one("/PYRAMID", 1, {100, 90, 80, 70, 5, -5, 60});
  one("/BOX", 2, {10, 20, 30});
  one("/RTORUS", 3, {100, 150, 20, 1.5F});
  one("/CTORUS", 4, {100, 20, 1.5F});
  one("/EDISH", 5, {100, 40});
  one("/SDISH", 6, {100, 40});
  one("/SNOUT", 7, {50, 40, 100, 5, 6, 0.1F, 0.2F, -0.1F, 0});
  one("/CYLINDER", 8, {25, 300});
  one("/SPHERE", 9, {80});
  one("/LINE", 10, {5, 100});
  w.cntb("/FACETS", version)
      .facets({{{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}}}, {{{0, 0, 0}, {0, 10, 0}, {0, 0, 10}}}})
      .cnte(version);
  w.cnte(version).finish();
  return w;
}

TEST(RvmReader, ReadsEveryKindInEveryVersion) {
  for (std::uint32_t version = 1; version <= 4; ++version) {
    const auto model = read(all_kinds(version));
    ASSERT_TRUE(model) << model.error().text();
    EXPECT_EQ(model->groups.size(), 12U) << version;
    EXPECT_EQ(model->objects.size(), 11U) << version;
    EXPECT_EQ(model->shapes.size(), 11U) << version;
    ASSERT_EQ(model->bodies.size(), 11U) << version;
    // The stored box of the dish test is not its own, which is noticed; nothing else is.
    EXPECT_EQ(model->diagnostics.kept().size(), 1U) << version;
    EXPECT_EQ(model->diagnostics.count("rvm-dish-radius"), 1U);
  }
}

const geometry::Primitive& primitive_of(const model::Model& model, std::size_t body) {
  return std::get<geometry::Primitive>(model.shapes.at(model::index(model.bodies.at(body).shape)));
}

/// A file of one group with one box, to which a test adds its defect.
RvmWriter one_box() {
  RvmWriter w;
  w.head().modl().cntb("/A").prim(2, {10, 20, 30}, RvmWriter::at(1, 2, 3)).cnte();
  return w;
}

TEST(RvmReader, SharesEqualShapesAndKeepsTheOrderOfAGroupsPrimitives) {
  RvmWriter w;
  w.head().modl().cntb("/A").prim(2, {10, 20, 30});
  w.cntb("/A/CHILD").prim(9, {80}).cnte();
  w.prim(8, {5, 50}).prim(2, {10, 20, 30}, RvmWriter::at(1, 0, 0)).cnte().finish();
  const auto model = read(w);
  ASSERT_TRUE(model) << model.error().text();
  ASSERT_EQ(model->objects.size(), 2U);
  EXPECT_EQ(model->objects[0].name, "/A");
  EXPECT_EQ(model->objects[0].body_count, 3U);
  EXPECT_EQ(model->objects[1].name, "/A/CHILD");
  EXPECT_EQ(model->objects[1].id, "/A/A/CHILD");
  EXPECT_EQ(model->path(model->objects[1]), "/A");
  EXPECT_EQ(model->shapes.size(), 3U);
  EXPECT_EQ(model->bodies[0].shape, model->bodies[2].shape);
  EXPECT_EQ(model->bodies[2].placement.translation, Vec3d(1000, 0, 0));
}

TEST(RvmReader, UndoesTheRoundingOfSinglePrecisionAndOnlyThat) {
  RvmWriter w;
  w.head().modl().cntb("/A");
  w.prim(2, {1, 1, 1}, RvmWriter::at(336.118F, 311.9320068F, -0.1F));
  std::array<float, 12> turned = RvmWriter::kUnitMatrix;  // by a quarter, as single precision does
  turned[0] = -4.37113883e-11F;
  turned[1] = 0.001F;
  turned[3] = -0.001F;
  turned[4] = -4.37113883e-11F;
  w.prim(2, {1, 1, 1}, turned);
  std::array<float, 12> scaled = RvmWriter::kUnitMatrix;  // twice as long along x: left alone
  scaled[0] = 0.002F;
  w.prim(2, {1, 1, 1}, scaled).cnte().finish();
  const auto model = read(w);
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(model->bodies[0].placement.translation, Vec3d(336118, 311932, -100));
  EXPECT_EQ(model->bodies[0].placement.linear, geometry::Mat3d());
  const geometry::Mat3d quarter{{Vec3d{0, -1, 0}, Vec3d{1, 0, 0}, Vec3d{0, 0, 1}}};
  EXPECT_EQ(model->bodies[1].placement.linear, quarter);
  EXPECT_NEAR(model->bodies[2].placement.linear.row[0].x, 2, 1e-6);
  // Half of one step of a float32 at 336 m.
  EXPECT_NEAR(model->files[0].precision_mm, 0.0152587890625, 1e-12);
}

TEST(RvmReader, ObstructionsAndInsulationKeepTheirClassAndTransparency) {
  RvmWriter w;
  w.head().modl().cntb("/A", 2, 2);
  w.volume("OBST", 50, 2, {10, 10, 10}, RvmWriter::at(1, 0, 0));
  w.volume("INSU", 100, 8, {10, 10}, RvmWriter::at(2, 0, 0));
  w.volume("OBST", 25, 9, {10}, RvmWriter::at(3, 0, 0), true);
  w.cnte().finish();
  const auto model = read(w);
  ASSERT_TRUE(model) << model.error().text();
  ASSERT_EQ(model->bodies.size(), 3U);
  EXPECT_EQ(model->bodies[0].category, model::Category::obstruction);
  EXPECT_EQ(model->bodies[0].color, (model::Color{204, 0, 0, 127}));
  EXPECT_EQ(model->bodies[1].category, model::Category::insulation);
  EXPECT_EQ(model->bodies[1].color.alpha, 0);
  EXPECT_EQ(model->bodies[2].placement.translation, Vec3d(3000, 0, 0));
  EXPECT_EQ(model->bodies[2].color.alpha, 191);
  EXPECT_EQ(model->diagnostics.count("rvm-shifted-matrix"), 1U);
}

TEST(RvmReader, ColoursComeFromThePaletteTheFileAndTheParent) {
  RvmWriter w;
  w.head().modl();
  w.cntb("/OWN", 2, 7).prim(9, {1}).cnte();
  w.cntb("/LEFT OPEN", 2, 194).prim(9, {1}).cnte();
  w.cntb("/SEEN THROUGH", 3, 6, 40).cntb("/INHERITS", 3, 6).prim(9, {1}).cnte(3).cnte(3);
  w.colr(7, 1, 2, 3).finish();
  const auto model = read(w);
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(model->bodies[0].color, (model::Color{1, 2, 3, 255}));
  EXPECT_EQ(model->bodies[1].color, (model::Color{120, 120, 120, 255}));
  EXPECT_EQ(model->bodies[2].color.alpha, 153);
  EXPECT_EQ(model->diagnostics.count("rvm-material"), 1U);
}

TEST(RvmReader, FacetGroupsWeldTriangulateAndKeepFaces) {
  RvmWriter w;
  // A 10 x 10 plate with a 2 x 2 hole, a planar quadrilateral, a bent one, a concave one.
  w.head().modl().cntb("/A").facets({{{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}},
                                      {{4, 4, 0}, {4, 6, 0}, {6, 6, 0}, {6, 4, 0}}},
                                     {{{0, 0, 0}, {0, 10, 0}, {0, 10, 10}, {0, 0, 10}}},
                                     {{{20, 0, 0}, {30, 0, 0}, {30, 10, 5}, {20, 10, 0}}},
                                     {{{40, 0, 0}, {44, 1, 0}, {50, 0, 0}, {44, 10, 0}}}});
  w.cnte().finish();
  const auto model = read(w);
  ASSERT_TRUE(model) << model.error().text();
  const auto& mesh = std::get<geometry::TriangleMesh>(model->shapes.at(0));
  EXPECT_EQ(mesh.vertices.size(), 18U);
  EXPECT_EQ(mesh.triangles.size(), 8U + 2 + 2 + 2);
  EXPECT_EQ(mesh.faces.back(), 4U) << "the bent quadrilateral is two faces";
  EXPECT_LT(mesh.sag_mm, 0);
  double area = 0;
  for (const geometry::Triangle& t : mesh.triangles) {
    const Vec3d n =
        cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    if (mesh.vertices[t[0]].x >= 40) {
      EXPECT_GT(n.z, 0) << "outside the concave corner";
      area += n.z / 2;
    }
  }
  EXPECT_DOUBLE_EQ(area, 45);
}

TEST(RvmReader, PolygonsWithoutAreaKeepTheirEdges) {
  RvmWriter w;
  w.head().modl().cntb("/A");
  w.facets({{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {5, 0, 0}}}}).cnte().finish();
  const auto model = read(w);
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(std::get<geometry::TriangleMesh>(model->shapes.at(0)).triangles.size(), 3U);
  EXPECT_EQ(model->diagnostics.count("rvm-facet-polygon"), 0U);
}

TEST(RvmReader, LeavesOutBadPolygonsAndReportsIt) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  RvmWriter w;
  w.head().modl().cntb("/A");
  w.facets({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
            {{{0, 0, kNan}, {1, 0, 0}, {0, 1, 0}}},
            {{{0, 0, 0}, {1, 0, 0}}},
            {}});
  w.cnte().cntb("/B").facets({{{{0, 0, 0}, {0, 0, 0}, {0, 1, 0}}}}).cnte().finish();
  const auto model = read(w);
  ASSERT_TRUE(model) << model.error().text();
  ASSERT_EQ(model->bodies.size(), 1U);
  EXPECT_EQ(std::get<geometry::TriangleMesh>(model->shapes.at(0)).triangles.size(), 1U);
  EXPECT_EQ(model->diagnostics.count("rvm-facet-left-out"), 1U);
  EXPECT_EQ(model->diagnostics.count("rvm-facet-polygon"), 2U);
  EXPECT_EQ(model->diagnostics.count("rvm-empty-facets"), 1U);
  // The object whose only primitive is unusable is still listed.
  ASSERT_EQ(model->objects.size(), 2U);
  EXPECT_EQ(model->objects[1].name, "/B");
  EXPECT_EQ(model->objects[1].body_count, 0U);
  EXPECT_TRUE(model->objects[0].incomplete);
  EXPECT_TRUE(model->objects[1].incomplete);
}

/// A number that is none, at any place where a primitive is built from numbers, is told as
/// something missing, and the object as incomplete: of every kind, in matrix, parameters and
/// facets.
TEST(RvmReader, NoBadNumberIsPassedOver) {
  constexpr std::size_t kMatrixWords = 2, kBoxWords = 14, kParameterWords = 20;
  const std::vector<std::pair<std::uint32_t, std::vector<float>>> kinds{
      {1, {10, 10, 5, 5, 1, 1, 10}},
      {2, {10, 20, 30}},
      {3, {10, 20, 5, 1}},
      {4, {20, 5, 1}},
      {5, {10, 5}},
      {6, {10, 5}},
      {7, {10, 5, 20, 1, 1, 0.1F, 0, 0, 0.1F}},
      {8, {10, 20}},
      {9, {10}},
      {10, {0, 10}}};
  const auto check = [](const RvmWriter& w, std::uint32_t kind, std::size_t word, bool reported) {
    const auto model = read(w);
    ASSERT_TRUE(model) << model.error().text();
    ASSERT_EQ(model->objects.size(), 2U) << kind << ' ' << word;
    EXPECT_EQ(model->objects[1].incomplete, reported) << kind << ' ' << word;
    EXPECT_EQ(model->diagnostics.skipped() > 0, reported) << kind << ' ' << word;
    EXPECT_FALSE(model->diagnostics.kept().empty()) << kind << ' ' << word;
  };
  for (const std::uint32_t bits : {0x7FC00000U, 0x7F800000U, 0xFF800000U}) {
    for (const auto& [kind, parameters] : kinds) {
      for (std::size_t word = kMatrixWords; word < kParameterWords + parameters.size(); ++word) {
        RvmWriter w = one_box();
        w.cntb("/B").prim(kind, parameters).set_word(4 * word, bits).cnte().finish();
        check(w, kind, word, word < kBoxWords || word >= kParameterWords);
      }
    }
    for (std::size_t vertex = 0; vertex < 4; ++vertex) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        RvmWriter w = one_box();
        w.cntb("/B").facets(
            {{{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}}}, {{{0, 0, 1}, {9, 0, 1}, {9, 9, 1}}}});
        // Behind the counts of polygons, contours and corners.
        const std::size_t word = kParameterWords + 3 + 6 * vertex + axis;
        w.set_word(4 * word, bits).cnte().finish();
        check(w, 11, word, true);
      }
    }
  }
}

TEST(RvmReader, SkipsBadPrimitivesWithTheirOffset) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  RvmWriter w = one_box();
  w.cntb("/B");
  w.prim(8, {50, 400}, RvmWriter::at(0, kInfinity, 0));
  const std::size_t bad_matrix = w.last_chunk();
  w.prim(2, {10, -20, 30}).prim(9, {0}).prim(7, {0, 0, 10, 0, 0, 0, 0, 0, 0});
  w.prim(12, {1}).prim(9, {5}).cnte().finish();
  const auto model = read(w);
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(model->bodies.size(), 2U);
  EXPECT_EQ(model->diagnostics.count("rvm-nonfinite-matrix"), 1U);
  EXPECT_EQ(model->diagnostics.count("rvm-bad-primitive"), 3U);
  EXPECT_EQ(model->diagnostics.count("rvm-unknown-kind"), 1U);
  EXPECT_EQ(model->diagnostics.skipped(), 5U);
  EXPECT_EQ(model->diagnostics.kept().at(0).where, "test.rvm, byte " + std::to_string(bad_matrix));
}

TEST(RvmReader, LinesTakeTheirLengthFromTheBoxWhenTheyStateNone) {
  RvmWriter w;
  w.head().modl().cntb("/A").prim(10, {5, 100});
  w.prim(10, {5, 0}, RvmWriter::kUnitMatrix, {-5, -5, -30, 5, 5, 30}).cnte().finish();
  const auto model = read(w);
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(std::get<geometry::LinePrimitive>(primitive_of(*model, 0)).length, 100);
  EXPECT_EQ(std::get<geometry::LinePrimitive>(primitive_of(*model, 1)).length, 60);
}

TEST(RvmReader, GoesOnAfterDamage) {
  struct Case {
    const char* what;
    RvmWriter writer;
    const char* code;
    std::size_t bodies;
  };
  std::vector<Case> cases;
  const auto add = [&](const char* what, const char* code, std::size_t bodies, auto&& spoil) {
    RvmWriter w = one_box();
    w.cntb("/B");
    spoil(w);
    w.prim(9, {5}).cnte().finish();
    cases.push_back({what, w, code, bodies});
  };
  add("stray end of group", "rvm-stray-end", 2, [](RvmWriter& w) { w.cnte().cnte().cntb("/C"); });
  add("stale address, too far", "rvm-stale-address", 3,
      [](RvmWriter& w) { w.prim(9, {7}).set_next(0x00FFFFFF); });
  add("stale address, backwards", "rvm-stale-address", 3,
      [](RvmWriter& w) { w.prim(9, {7}).set_next(4); });
  add("extra bytes within a chunk", "rvm-extra-bytes", 3,
      [](RvmWriter& w) { w.prim(9, {7}).pad_last(12, true); });
  add("lost bytes between chunks", "rvm-lost-bytes", 3,
      [](RvmWriter& w) { w.prim(9, {7}).pad_last(13, false); });
  add("unknown chunk", "rvm-unknown-chunk", 2, [](RvmWriter& w) { w.chunk("WHAT", 20); });
  add("huge count of polygons", "rvm-damaged-chunk", 2, [](RvmWriter& w) {
    w.facets({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}}).set_word(80, 0xFFFFFFFF);
  });
  add("huge count of vertices", "rvm-damaged-chunk", 2, [](RvmWriter& w) {
    w.facets({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}}).set_word(88, 0x10000000);
  });
  add("string longer than the chunk", "rvm-damaged-chunk", 2,
      [](RvmWriter& w) { w.cntb("/C").set_word(4, 0x40000000); });
  for (const Case& c : cases) {
    const auto model = read(c.writer);
    ASSERT_TRUE(model) << c.what << ": " << model.error().text();
    EXPECT_EQ(model->bodies.size(), c.bodies) << c.what;
    EXPECT_EQ(model->diagnostics.count(c.code), 1U) << c.what;
    EXPECT_EQ(model->diagnostics.counts().size(), 1U) << c.what;
  }
}

/// Of a group of which nothing can be read there is an object all the same: otherwise nobody would
/// be told that it was not compared.
TEST(RvmReader, GroupsOfWhichNothingIsLeftAreInTheModel) {
  const auto objects_of = [](auto&& spoil) {
    RvmWriter w = one_box();
    w.cntb("/B");
    spoil(w);
    w.cnte().finish();
    const auto model = read(w);
    EXPECT_TRUE(model);
    return model ? model->objects : std::vector<model::Object>{};
  };
  const auto lost = [&](const char* what, auto&& spoil) {
    const std::vector<model::Object> objects = objects_of(spoil);
    ASSERT_EQ(objects.size(), 2U) << what;
    EXPECT_FALSE(objects[0].incomplete) << what;
    EXPECT_EQ(objects[1].name, "/B") << what;
    EXPECT_EQ(objects[1].body_count, 0U) << what;
    EXPECT_TRUE(objects[1].incomplete) << what;
  };
  lost("a kind that is not known", [](RvmWriter& w) { w.prim(12, {1}).prim(13, {1}); });
  lost("a chunk that is not known", [](RvmWriter& w) { w.chunk("WHAT", 20).chunk("WHAT", 20); });
  lost("a damaged chunk", [](RvmWriter& w) {
    w.facets({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}}).set_word(80, 0xFFFFFFFF);
  });
  lost("lost bytes", [](RvmWriter& w) { w.raw("nobody knows what this was"); });
  // A colour that cannot be read is no loss of geometry.
  EXPECT_EQ(objects_of([](RvmWriter& w) { w.chunk("COLR", 4); }).size(), 1U);
}

TEST(RvmReader, AGroupThatTheFileEndsInIsIncomplete) {
  RvmWriter w = one_box();
  w.cntb("/B").prim(9, {5});
  const auto cut = read(w);
  ASSERT_TRUE(cut);
  ASSERT_EQ(cut->objects.size(), 2U);
  EXPECT_FALSE(cut->objects[0].incomplete);
  EXPECT_TRUE(cut->objects[1].incomplete);
  EXPECT_EQ(cut->objects[1].body_count, 1U);
  EXPECT_EQ(cut->diagnostics.skipped(), 1U);
  EXPECT_TRUE(cut->files[0].ends_early);

  // All that it has is whole, but nobody knows what else there was.
  const auto closed = read(one_box());
  ASSERT_TRUE(closed);
  EXPECT_FALSE(closed->objects[0].incomplete);
  EXPECT_EQ(closed->diagnostics.count("rvm-truncated"), 1U);
  EXPECT_EQ(closed->diagnostics.skipped(), 1U);
  EXPECT_TRUE(closed->files[0].ends_early);
}

TEST(RvmReader, OnlyAFileWithoutAnEndEndsEarly) {
  const auto whole = read(one_box().cnte().finish());
  ASSERT_TRUE(whole);
  EXPECT_FALSE(whole->files[0].ends_early);
  EXPECT_EQ(whole->diagnostics.count("rvm-truncated"), 0U);
  const auto unclosed = read(one_box().cntb("/B").prim(9, {5}).finish());
  ASSERT_TRUE(unclosed);
  EXPECT_FALSE(unclosed->files[0].ends_early);
}

TEST(RvmReader, AcceptsPrimitivesOutsideGroupsLeadingBytesAndAMissingEnd) {
  RvmWriter w;
  w.raw("junk!").head().modl("/ROOT").prim(9, {5}).cntb("/A").prim(9, {5});
  const auto model = read(w);
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(make_rvm_reader()->recognise({"x", w.bytes()}), 80);
  ASSERT_EQ(model->objects.size(), 2U);
  EXPECT_EQ(model->objects[0].name, "/ROOT");
  EXPECT_EQ(model->objects[0].parent, model::GroupId::none);
  EXPECT_EQ(model->diagnostics.count("rvm-leading-bytes"), 1U);
  EXPECT_EQ(model->diagnostics.count("rvm-truncated"), 1U);
}

TEST(RvmReader, NestingIsBoundedByTheFileNotByTheStack) {
  constexpr std::size_t kDepth = 30000;
  RvmWriter w;
  w.head().modl();
  for (std::size_t i = 0; i < kDepth; ++i) w.cntb("/D");
  w.prim(9, {5});
  for (std::size_t i = 0; i < kDepth; ++i) w.cnte();
  w.finish();
  const auto model = read(w);
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(model->groups.size(), 10000U);
  EXPECT_EQ(model->diagnostics.count("rvm-too-deep"), kDepth - 10000);
  EXPECT_EQ(model->diagnostics.count("rvm-stray-end"), 0U);
  // A path of 10 000 names is no id: the place in the file is.
  EXPECT_EQ(model->objects.at(0).id.front(), '@');
}

TEST(RvmReader, RefusesWhatIsNoRvmWithAReason) {
  const auto refused = [](std::string_view bytes, const char* path) {
    return make_rvm_reader()->read({path, std::as_bytes(std::span(bytes))}, {}, {}).error();
  };
  EXPECT_NE(refused("", "a.rvm").message.find("empty"), std::string::npos);
  EXPECT_NE(refused("solid x", "a.rvm").message.find("HEAD"), std::string::npos);
  EXPECT_NE(refused("x", "a.rvs").message.find("Review state"), std::string::npos);
  const std::string swapped("H\0\0\0E\0\0\0A\0\0\0D\0\0\0", 16);
  EXPECT_NE(refused(swapped, "a.rvm").message.find("low byte first"), std::string::npos);
  RvmWriter empty;
  empty.head().modl().cntb("/A").cnte().finish();
  EXPECT_EQ(read(empty).error().code, ErrorCode::input);
}

TEST(RvmReader, NamesAreUtf8WhateverTheFileHolds) {
  RvmWriter w;
  w.head(1).modl().cntb("/R\xF8r").prim(9, {5}).cnte();  // Latin-1
  w.cntb("/R\xC3\xB8r").prim(9, {5}).cnte();             // UTF-8
  w.cntb("/\x8A\xBF").prim(9, {5}).cnte().finish();      // Windows-1252, or Shift_JIS
  const auto model = read(w);
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(model->objects[0].name, "/R\xC3\xB8r");
  EXPECT_EQ(model->objects[1].name, "/R\xC3\xB8r");
  EXPECT_EQ(model->objects[2].name, "/\xC5\xA0\xC2\xBF");
  ReadOptions japanese;
  japanese.encoding = "Shift_JIS";
  const auto other = read(w, japanese);
  ASSERT_TRUE(other) << other.error().text();
  EXPECT_EQ(other->objects[2].name, "/\xE6\xBC\xA2");
  ReadOptions unknown;
  unknown.encoding = "KLINGON-8";
  EXPECT_EQ(read(w, unknown).error().code, ErrorCode::usage);
}

TEST(RvmReader, EveryTruncationAndEveryFlippedByteIsSurvived) {
  const std::vector<std::byte> good = all_kinds(4).bytes();
  for (std::size_t length = 0; length <= good.size(); ++length) {
    const std::vector<std::byte> cut(good.begin(),
                                     good.begin() + static_cast<std::ptrdiff_t>(length));
    const auto model = read(cut);
    EXPECT_TRUE(model || !model.error().message.empty());
  }
  for (std::size_t at = 0; at < good.size(); ++at)
    for (const unsigned mask : {0x01U, 0x80U, 0xFFU}) {
      std::vector<std::byte> flipped = good;
      flipped[at] ^= static_cast<std::byte>(mask);
      const auto model = read(flipped);
      if (!model) continue;
      for (const model::Body& body : model->bodies)
        ASSERT_LT(model::index(body.shape), model->shapes.size());
    }
}

}  // namespace
}  // namespace strake::io
