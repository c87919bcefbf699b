// SPDX-License-Identifier: Apache-2.0
// Skins that cross each other everywhere have as many lines as the product of their triangles: more
// than any model has are refused before they take the memory.
#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "strake/hlr/hlr.hpp"
#include "strake/parallel/team.hpp"
#include "support/scene_builder.hpp"

namespace strake {
namespace {

/// Triangles that lie anyhow in a box of a metre.
test::HandPart soup(std::size_t triangles, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<std::int32_t> coordinate(0, 1'000'000);
  test::HandPart part;
  std::set<geometry::Vec3i> taken;
  while (part.vertices.size() < 3 * triangles) {
    const geometry::Vec3i v{coordinate(random), coordinate(random), coordinate(random)};
    if (taken.insert(v).second) part.vertices.push_back(v);
  }
  for (std::uint32_t i = 0; i < 3 * triangles; i += 3) part.triangles.push_back({i, i + 1, i + 2});
  return part;
}

std::string error_of(const test::SceneBuilder& scene, const parallel::Context& context,
                     hlr::Intersections intersections = hlr::Intersections::objects) {
  const hlr::View view{.direction = {1, -1, 1}, .limits = {}};
  const auto drawing =
      hlr::draw(scene.scene(), {}, view, {.intersections = intersections}, context);
  if (drawing) return "";
  EXPECT_EQ(drawing.error().code, ErrorCode::input);
  return drawing.error().text();
}

TEST(IntersectionLimit, SkinsThatCrossEverywhereAreRefused) {
  constexpr std::uint32_t kSeed = 4711;
  SCOPED_TRACE(kSeed);
  test::SceneBuilder scene;
  for (const std::uint32_t k : {0U, 1U}) scene.object({{{soup(2900, kSeed + k)}, {}}});
  const std::string reported = error_of(scene, {});
  EXPECT_NE(reported.find("cross each other along more than 1580000 lines"), std::string::npos)
      << reported;
  EXPECT_NE(reported.find("--intersections off"), std::string::npos) << reported;
  parallel::Team team(3);
  EXPECT_EQ(error_of(scene, {.team = &team}), reported);
}

TEST(IntersectionLimit, WhatSmallSoupsHaveIsDrawn) {
  test::SceneBuilder scene;
  for (const std::uint32_t k : {0U, 1U, 2U}) scene.object({{{soup(60, k)}, {}}});
  EXPECT_EQ(error_of(scene, {}), "");
}

}  // namespace
}  // namespace strake
