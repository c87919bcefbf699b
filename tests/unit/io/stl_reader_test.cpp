// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <string>

#include "support/io_files.hpp"

namespace strake::io {
namespace {

using geometry::TriangleMesh;
using geometry::Vec3d;

Result<model::Model> read_stl(std::string_view bytes, const ReadOptions& options = {}) {
  return test::read_bytes(*make_stl_reader(), bytes, "some/part.stl", options);
}

int sureness(std::string_view bytes, const char* path = "part.stl") {
  return make_stl_reader()->recognise({path, std::as_bytes(std::span(bytes))});
}

using Facet = std::array<float, 12>;  // normal, three corners

std::string binary(std::string header, const std::vector<Facet>& facets) {
  header.resize(80, ' ');
  const auto count = static_cast<std::uint32_t>(facets.size());
  header.append(reinterpret_cast<const char*>(&count), 4);
  for (const Facet& facet : facets) {
    header.append(reinterpret_cast<const char*>(facet.data()), sizeof facet);
    header.append(2, '\0');
  }
  return header;
}

constexpr Facet kFacet{0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.5F};

constexpr std::string_view kText =
    "solid first one\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1.5e0 0 0\n"
    "   vertex 0 1 -2.5\n  endloop\n endfacet\nendsolid first one\n";

TEST(StlReader, ReadsBinaryEvenWhenItBeginsLikeText) {
  const std::string bytes = binary("solid exported by somebody", {kFacet, kFacet});
  EXPECT_EQ(sureness(bytes), 100);
  const Result<model::Model> model = read_stl(bytes);
  ASSERT_TRUE(model) << model.error().text();
  ASSERT_EQ(model->objects.size(), 1U);
  EXPECT_EQ(model->objects[0].name, "part");
  EXPECT_EQ(model->files[0].format, "STL binary");
  EXPECT_EQ(model->files[0].unit, "mm (assumed)");
  const auto& mesh = std::get<TriangleMesh>(model->shapes[0]);
  ASSERT_EQ(mesh.triangles.size(), 2U);
  EXPECT_EQ(mesh.vertices[5], (Vec3d{0, 1, 0.5}));
  EXPECT_EQ(model->files[0].precision_mm, std::ldexp(1.0, -24)) << "float32 at 1 mm";
}

TEST(StlReader, ReadsTextWithSeveralSolids) {
  std::string text(kText);
  text +=
      "SOLID\r\n\tFACET NORMAL 0 0 1\r\nOUTER LOOP\r\nVERTEX 0 0 0\r\nVERTEX 1 0 0\r\nVERTEX 0 1 "
      "0\r\n"
      "ENDLOOP\r\nENDFACET\r\nENDSOLID\r\nsolid empty\nendsolid\n";
  const Result<model::Model> model = read_stl(text);
  ASSERT_TRUE(model) << model.error().text();
  ASSERT_EQ(model->objects.size(), 2U);
  EXPECT_EQ(model->objects[0].name, "first one");
  EXPECT_EQ(model->objects[1].name, "part");
  const auto& mesh = std::get<TriangleMesh>(model->shapes[0]);
  EXPECT_EQ(mesh.vertices, (std::vector<Vec3d>{{0, 0, 0}, {1.5, 0, 0}, {0, 1, -2.5}}));
}

TEST(StlReader, AppliesUnitAndUpAxis) {
  ReadOptions options;
  options.unit_mm = 1000;
  options.up_axis = UpAxis::y;
  for (const std::string& bytes : {binary("x", {kFacet}), std::string(kText)}) {
    const Result<model::Model> model = read_stl(bytes, options);
    ASSERT_TRUE(model);
    EXPECT_EQ(model->files[0].unit, "m (given)");
    const Vec3d& last = std::get<TriangleMesh>(model->shapes[0]).vertices[2];
    EXPECT_EQ(last.z, 1000);
    EXPECT_LT(std::fabs(last.y) - 2500, 1e-9);
  }
}

TEST(StlReader, SkipsDamagedSolidsAndStatesWhere) {
  const std::string good(kText);
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  const std::vector<std::pair<std::string, std::string>> cases{
      {with("1.5e0 0 0", "1.5e0 0"), "some/part.stl:5"},
      {with("1.5e0 0 0", "nan 0 0"), "some/part.stl:5"},
      {with("   vertex 1.5e0 0 0\n", ""), "some/part.stl:6"},
      {with("   vertex 1.5e0 0 0\n", "vertex 1 1 1\nvertex 2 2 2\n"), "some/part.stl:8"},
      {good.substr(0, good.find("  endloop")), "some/part.stl:7"},
  };
  for (const auto& [text, place] : cases) {
    const Result<model::Model> alone = read_stl(text);
    ASSERT_FALSE(alone) << text;
    EXPECT_EQ(alone.error().where, place) << text;
    const Result<model::Model> both = read_stl(text + good);
    ASSERT_TRUE(both) << text;
    ASSERT_EQ(both->objects.size(), 2U) << "the damaged one is listed, without bodies";
    EXPECT_TRUE(both->objects[0].incomplete && both->objects[0].body_count == 0);
    EXPECT_TRUE(!both->objects[1].incomplete && both->objects[1].body_count == 1);
    EXPECT_EQ(both->diagnostics.count("stl-damaged-solid"), 1U);
  }
}

/// Several damaged facets, each in its way, between two good ones.
TEST(StlReader, KeepsASolidWithoutTheFacetsThatCannotBeRead) {
  const auto facet = [](const std::string& corners) {
    return "facet normal 0 0 1\nouter loop\n" + corners + "endloop\nendfacet\n";
  };
  const std::string good = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";
  const std::string text =
      "solid s\n" + facet(good) + facet("vertex 0 0 0\nvertex inf 0 0\nvertex 0 7 0\n") +
      facet("vertex 0 0 0\nvertex 0 8 0\n") + facet(good + "vertex 9 9 9\n") +
      facet("vertex nan 0 0\nvertex nan 0 0\nvertex nan 0 0\n") +
      facet("vertex 0 0 0\nvertx 1 0 0\nvertex 0 1 0\n") + facet(good) + "endsolid s\n";
  const Result<model::Model> model = read_stl(text);
  ASSERT_TRUE(model) << model.error().text();
  ASSERT_EQ(model->objects.size(), 1U);
  EXPECT_TRUE(model->objects[0].incomplete);
  const auto& mesh = std::get<TriangleMesh>(model->shapes[0]);
  EXPECT_EQ(mesh.triangles.size(), 2U);
  EXPECT_EQ(mesh.vertices.size(), 6U);
  for (const Vec3d& vertex : mesh.vertices) EXPECT_LE(vertex.x + vertex.y, 1);
  ASSERT_EQ(model->diagnostics.kept().size(), 1U);
  const Diagnostic& reported = model->diagnostics.kept()[0];
  EXPECT_EQ(reported.severity, Severity::skipped);
  EXPECT_EQ(reported.message,
            "object 's' is kept without 5 faces: a vertex needs three finite numbers");
  EXPECT_EQ(reported.where, "some/part.stl:12");
}

TEST(StlReader, KeepsABinaryFileWithoutTheFacetsThatCannotBeRead) {
  Facet infinite = kFacet, no_number = kFacet;
  infinite[7] = INFINITY;
  no_number[11] = NAN;
  Facet last = kFacet;
  last[3] = 0.25F;
  const Result<model::Model> model = read_stl(binary("x", {kFacet, infinite, no_number, last}));
  ASSERT_TRUE(model) << model.error().text();
  const auto& mesh = std::get<TriangleMesh>(model->shapes[0]);
  EXPECT_EQ(mesh.triangles, (std::vector<geometry::Triangle>{{0, 1, 2}, {3, 4, 5}}));
  ASSERT_EQ(mesh.vertices.size(), 6U);
  EXPECT_EQ(mesh.vertices[3], (Vec3d{0.25, 0, 0}));
  EXPECT_TRUE(model->objects[0].incomplete);
  ASSERT_EQ(model->diagnostics.kept().size(), 1U);
  EXPECT_EQ(model->diagnostics.kept()[0].message,
            "object 'part' is kept without 2 faces: corner 2 of facet 2 is not finite");
  EXPECT_EQ(model->diagnostics.kept()[0].where, "some/part.stl, byte 158");
  EXPECT_EQ(model->diagnostics.skipped(), 1U);
}

TEST(StlReader, RefusesDamagedBinaryFiles) {
  std::string bytes = binary("x", {kFacet, kFacet, kFacet});
  const Result<model::Model> truncated = read_stl(bytes.substr(0, bytes.size() - 60));
  ASSERT_FALSE(truncated);
  EXPECT_EQ(truncated.error().where, "some/part.stl, byte 174");
  EXPECT_NE(truncated.error().message.find("1 of the 3 facets"), std::string::npos);

  Facet infinite = kFacet;
  infinite[7] = INFINITY;
  const Result<model::Model> not_finite = read_stl(binary("x", {infinite, infinite}));
  ASSERT_FALSE(not_finite);
  EXPECT_EQ(not_finite.error().where, "some/part.stl, byte 108");

  const std::uint32_t huge = 0xffffffffU;
  std::memcpy(bytes.data() + 80, &huge, 4);
  EXPECT_FALSE(read_stl(bytes));
  EXPECT_FALSE(read_stl(binary("x", {})));
  EXPECT_FALSE(read_stl("solid x\nendsolid x\n"));
  EXPECT_FALSE(read_stl("too short"));
}

TEST(StlReader, IgnoresBytesBehindTheLastFacetWithAWarning) {
  const Result<model::Model> model = read_stl(binary("x", {kFacet}) + "trailing");
  ASSERT_TRUE(model);
  EXPECT_EQ(model->diagnostics.count("stl-trailing-bytes"), 1U);
  EXPECT_FALSE(model->objects[0].incomplete);
}

TEST(StlReader, ReportsASecondSolidThatItDoesNotRead) {
  const Result<model::Model> model = read_stl(binary("x", {kFacet}) + binary("y", {kFacet}));
  ASSERT_TRUE(model);
  EXPECT_EQ(model->diagnostics.skipped(), 1U);
  EXPECT_TRUE(model->objects[0].incomplete);
}

TEST(StlReader, ReadsTextBehindAByteOrderMark) {
  const std::string text = std::string("\xEF\xBB\xBF") + std::string(kText);
  const Result<model::Model> model = read_stl(text);
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(model->objects.size(), read_stl(kText)->objects.size());
  EXPECT_GT(sureness(text, "x.txt"), 80);
}

TEST(StlReader, RecognisesItsContent) {
  EXPECT_GT(sureness(kText, "x.txt"), 80);
  EXPECT_GT(sureness(binary("x", {kFacet}), "x.bin"), 50);
  EXPECT_EQ(sureness("solids are nice", "x.txt"), 0);
  EXPECT_EQ(sureness("v 0 0 0\nf 1 1 1\n", "x.obj"), 0);
  EXPECT_EQ(sureness("", "x.obj"), 0);
}

}  // namespace
}  // namespace strake::io
