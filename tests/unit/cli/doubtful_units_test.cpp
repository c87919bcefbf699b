// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "cli/run/load.hpp"
#include "strake/parallel/team.hpp"
#include "support/meshes.hpp"

namespace strake::cli {
namespace {

using geometry::Vec3d;

struct File {
  Vec3d size;
  std::string unit = "mm (assumed)";
};

/// What is told where each file holds one box of its size.
Diagnostics reported(const std::vector<File>& files, const Vec3d& at = {}) {
  model::Model model;
  for (const File& file : files) {
    const auto number = static_cast<std::uint32_t>(model.files.size());
    model.files.push_back({std::to_string(number) + ".stl", "STL", file.unit, "z", 1, 0});
    model.shapes.emplace_back(test::box_mesh(at, at + file.size));
    model::Object object;
    object.id = std::to_string(number);
    object.file = number;
    object.first_body = number;
    object.body_count = 1;
    model.objects.push_back(object);
    model::Body body;
    body.shape = model::ShapeId{number};
    model.bodies.push_back(body);
  }
  model::Scene scene = model::make_scene(model, {}, {}).value();
  EXPECT_TRUE(note_doubtful_units(scene, {}));
  return scene.diagnostics;
}

/// How often units are doubted.
std::uint64_t doubts(const std::vector<File>& files, const Vec3d& at = {}) {
  return reported(files, at).count("unit-doubtful");
}

/// The words of the only doubt.
std::string doubt(const std::vector<File>& files) {
  const Diagnostics diagnostics = reported(files);
  EXPECT_EQ(diagnostics.kept().size(), 1U);
  return diagnostics.kept().empty() ? "" : diagnostics.kept().front().message;
}

Vec3d scaled(const Vec3d& v, double factor) { return v * factor; }

constexpr Vec3d kPart{120, 80, 35};

TEST(DoubtfulUnits, FactorsBetweenUnitsAreReportedWhicheverFileIsFirst) {
  for (const double factor : {1000.0, 25.4, 1000 / 25.4, 304.8, 940.0, 1080.0, 25.5}) {
    const File large{kPart}, small{scaled(kPart, 1 / factor)};
    EXPECT_EQ(doubts({large, small}), 1U) << factor;
    EXPECT_EQ(doubts({small, large}), 1U) << factor;
    EXPECT_EQ(doubts({small, large}, {5000, -300, 20}), 1U) << factor;
  }
}

TEST(DoubtfulUnits, OtherFactorsAreNot) {
  for (const double factor :
       {1.0, 2.0, 5.0, 10.0, 12.0, 20.0, 25.0, 26.0, 31.0, 40.0, 60.0, 100.0, 200.0, 500.0})
    EXPECT_EQ(doubts({{kPart}, {scaled(kPart, 1 / factor)}}), 0U) << factor;
}

TEST(DoubtfulUnits, OneAxisThatDiffersIsEnoughToTrust) {
  for (int k = 0; k < 3; ++k) {
    Vec3d small = scaled(kPart, 1 / 25.4);
    small[k] *= 1.5;
    EXPECT_EQ(doubts({{kPart}, {small}}), 0U) << k;
  }
}

TEST(DoubtfulUnits, AUnitThatSomebodyStatesIsTrustedBesideOneThatIsKnown) {
  const Vec3d small = scaled(kPart, 0.001);
  for (const char* known : {"mm (given)", "m (stated)"}) {
    EXPECT_EQ(doubts({{kPart, known}, {small}}), 1U) << known;
    EXPECT_EQ(doubts({{kPart}, {small, known}}), 1U) << known;
  }
  for (const char* other : {"mm (given)", "m (stated)"}) {
    EXPECT_EQ(doubts({{kPart, "mm (given)"}, {small, other}}), 0U) << other;
    EXPECT_EQ(doubts({{kPart, other}, {small, "mm (given)"}}), 0U) << other;
  }
}

TEST(DoubtfulUnits, WhatBothFormatsStateIsDoubtedUntilSomebodyStatesAUnit) {
  // As a glTF file in millimetres beside an RVM file: both formats prescribe metres.
  const File plant{scaled(kPart, 0.001), "m (stated)"}, model{kPart, "m (stated)"};
  EXPECT_EQ(doubts({plant, model}), 1U);
  EXPECT_TRUE(doubt({plant, model}).ends_with("say --unit '1.stl=mm'")) << doubt({plant, model});
}

TEST(DoubtfulUnits, NoOtherUnitIsAdvisedOfAFileWhoseUnitIsKnown) {
  const auto ends_in = [](const std::string& text, const std::string& end) {
    return text.ends_with("say " + end);
  };
  const Vec3d small = scaled(kPart, 0.001);
  EXPECT_PRED2(ends_in, doubt({{kPart}, {small}}), "--unit '1.stl=m' --unit '0.stl=mm'");
  EXPECT_PRED2(ends_in, doubt({{kPart, "m (stated)"}, {small}}), "--unit '1.stl=m'");
  EXPECT_PRED2(ends_in, doubt({{kPart, "m (assumed)"}, {small, "mm (stated)"}}),
               "--unit '0.stl=mm'");
  // Read as millimetres and still too large: no unit that it may have instead is known.
  EXPECT_PRED2(ends_in, doubt({{kPart}, {small, "mm (stated)"}}), "--unit '0.stl=UNIT'");
}

TEST(DoubtfulUnits, WhicheverAxisIsUp) {
  const Vec3d small = scaled({kPart.x, kPart.z, kPart.y}, 0.001);
  EXPECT_EQ(doubts({{kPart, "m (stated)"}, {small}}), 1U);
}

TEST(DoubtfulUnits, WhatTheGridMakesFlatIsAlikeAndALineStatesNothing) {
  // A plate of 0.4 mm in metres has no thickness on the grid.
  EXPECT_EQ(doubts({{{200, 100, 0.4}}, {{0.2, 0.1, 0.0004}}}), 1U);
  EXPECT_EQ(doubts({{{200, 100, 30}}, {{0.2, 0.1, 0}}}), 0U);
  EXPECT_EQ(doubts({{{200, 0.4, 0.4}}, {{0.2, 0.002, 0.002}}}), 0U);
}

// Blocks of bodies have boxes of their own: the extents are those of all.
TEST(DoubtfulUnits, FilesOfManyBodiesAreReportedForAnyTeam) {
  constexpr std::uint32_t kMany = 10'000;
  model::Model model;
  for (const double scale : {1.0, 0.001}) {
    const auto file = static_cast<std::uint32_t>(model.files.size());
    model.files.push_back({std::to_string(file) + ".stl", "STL", "mm (assumed)", "z", 1, 0});
    model.shapes.emplace_back(test::box_mesh({}, scaled(kPart, scale)));
    for (std::uint32_t i = 0; i < kMany; ++i) {
      model::Object object;
      object.id = std::to_string(i);
      object.file = file;
      object.first_body = static_cast<std::uint32_t>(model.bodies.size());
      object.body_count = 1;
      model.objects.push_back(object);
      model::Body body;
      body.shape = model::ShapeId{file};
      body.placement.translation = scaled({i * 50.0, i * 20.0, i * 30.0}, scale);
      model.bodies.push_back(body);
    }
  }
  for (const unsigned threads : {1U, 2U, 3U, 8U}) {
    parallel::Team team(threads);
    model::Scene scene = model::make_scene(model, {}, {.team = &team}).value();
    ASSERT_TRUE(note_doubtful_units(scene, {.team = &team}));
    EXPECT_EQ(scene.diagnostics.count("unit-doubtful"), 1U) << threads;
  }
}

TEST(DoubtfulUnits, EachPairOfFilesIsReported) {
  const File small{scaled(kPart, 0.001)};
  EXPECT_EQ(doubts({{kPart}, {kPart}, small}), 2U);
  EXPECT_EQ(doubts({small}), 0U);
  EXPECT_EQ(doubts({}), 0U);
}

}  // namespace
}  // namespace strake::cli
