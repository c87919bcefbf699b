// SPDX-License-Identifier: Apache-2.0
// Many faces round one corner, and many equal objects at one place: what the definition gives, at a
// cost that grows with them and not with their square.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "strake/hlr/hlr.hpp"
#include "support/draw.hpp"
#include "support/hlr_oracle.hpp"
#include "support/rounds.hpp"
#include "support/scene_builder.hpp"

namespace strake {
namespace {

using test::Draw;

/// Needles from a corner to a rim that goes up and down; with a second corner below, a closed body.
test::HandPart fan(std::uint32_t count, std::int32_t height, std::int32_t waves, bool closed) {
  constexpr double kRadius = 1'000'000;
  test::HandPart part;
  part.vertices.push_back({0, 0, height});
  for (std::uint32_t i = 0; i < count; ++i) {
    const double turn = 2 * std::numbers::pi * i / count;
    part.vertices.push_back({static_cast<std::int32_t>(std::lround(kRadius * std::cos(turn))),
                             static_cast<std::int32_t>(std::lround(kRadius * std::sin(turn))),
                             i % 2 == 0 ? waves : -waves});
  }
  if (closed) part.vertices.push_back({0, 0, -height});
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t p = 1 + i, q = 1 + (i + 1) % count;
    part.triangles.push_back({0, p, q});
    if (closed) part.triangles.push_back({count + 1, q, p});
  }
  return part;
}

test::HandPart random_fan(Draw& draw) {
  const auto count = static_cast<std::uint32_t>(70 + draw.below(30));
  if (draw.one_in(3)) {  // through each other
    test::HandPart part;
    const auto corner = [&] {
      return geometry::Vec3i{draw.whole(-900, 900), draw.whole(-900, 900), draw.whole(-900, 900)};
    };
    part.vertices.push_back({3, 5, 7});
    for (std::uint32_t i = 0; i < count; ++i) {
      part.vertices.push_back(corner());
      part.vertices.push_back(corner());
      part.triangles.push_back({0, 2 * i + 1, 2 * i + 2});
    }
    return part;
  }
  return fan(count, draw.whole(-900'000, 900'000), draw.whole(0, 200'000), draw.one_in(2));
}

/// A view along which corners may lie behind each other.
hlr::View random_view(Draw& draw) {
  const std::int32_t most = draw.one_in(2) ? 2 : 20;
  hlr::View view;
  do
    view.direction = {draw.whole(-most, most + 1), draw.whole(-most, most + 1),
                      draw.whole(-most, most + 1)};
  while (view.direction == geometry::Vec3l{0, 0, 0});
  return view;
}

void expect_as_defined(const test::SceneBuilder& scene, const hlr::View& view) {
  hlr::Options options{.sharp_angle_deg = 0};
  options.solver = hlr::Solver::brute_force;
  const auto expected = hlr::draw(scene.scene(), {}, view, options, {});
  options.solver = hlr::Solver::gather;
  const auto got = hlr::draw(scene.scene(), {}, view, options, {});
  ASSERT_TRUE(expected && got);
  ASSERT_GT(expected->pieces.size(), 0U);
  EXPECT_EQ(test::difference(expected->pieces, got->pieces), "");
}

TEST(PolygonFans, AreDrawnAsDefined) {
  Draw draw(11);
  for (int round = 0; round < test::rounds(15, 1000); ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    test::SceneBuilder scene;
    scene.object({{.parts = {random_fan(draw)}, .origin = {}}});
    if (draw.one_in(2))
      scene.object({{.parts = {random_fan(draw)}, .origin = {draw.whole(-500, 500), 0, 100}}});
    expect_as_defined(scene, random_view(draw));
  }
}

TEST(PolygonFans, CostWhatTheirFacesCost) {
  // Waves so low that needles are not over each other on paper: what is there is to be tested.
  const auto tests_of = [](std::uint32_t count, const hlr::View& view) {
    test::SceneBuilder scene;
    scene.object({{.parts = {fan(count, 300'000, 300, false)}, .origin = {}}});
    const auto drawing = hlr::draw(scene.scene(), {}, view, {.sharp_angle_deg = 0}, {});
    EXPECT_EQ(drawing->counters.feature_edges, 2 * count);
    return drawing->counters.face_tests;
  };
  hlr::View view;
  for (const geometry::Vec3l& direction : {geometry::Vec3l{0, 0, 1}, geometry::Vec3l{1, -1, 1}}) {
    view.direction = direction;
    // Eight times as many.
    EXPECT_LT(tests_of(2000, view), 12 * tests_of(250, view));
  }
}

TEST(EqualObjects, AreDrawnAsDefined) {
  Draw draw(5);
  for (int round = 0; round < test::rounds(20, 300); ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    test::SceneBuilder scene;
    const auto corner = [&] { return draw.whole(0, 4); };
    const auto box = [&] {
      const geometry::Vec3i lo{corner(), corner(), corner()};
      return test::hand_box({100 * lo.x, 100 * lo.y, 100 * lo.z},
                            {100 * lo.x + 300, 100 * lo.y + 200, 100 * lo.z + 100});
    };
    scene.object({{.parts = {box()}, .origin = {}}, {.parts = {box()}, .origin = {}}});
    scene.object({{.parts = {box()},
                   .origin = {},
                   .alpha = draw.one_in(4) ? std::uint8_t{9} : std::uint8_t{255}}});
    const auto copies = 2 + draw.below(5);
    for (std::uint64_t i = 0; i < copies; ++i)
      scene.instance(static_cast<std::uint32_t>(draw.below(2)),
                     {draw.one_in(3) ? 100 : 0, 0, draw.one_in(5) ? 50 : 0});
    hlr::View view = random_view(draw);
    if (draw.one_in(3)) view.limits = {{{0, 0, 0}, {350, 350, draw.whole(100, 400)}}};
    expect_as_defined(scene, view);
  }
}

TEST(EqualObjects, CostWhatEachCosts) {
  const auto tests_of = [](int copies) {
    test::SceneBuilder scene;
    scene.object({{.parts = {test::hand_box({0, 0, 0}, {900, 800, 700})}, .origin = {}}});
    for (int i = 1; i < copies; ++i) scene.instance(0, {0, 0, 0});
    hlr::View view;
    view.direction = {1, -1, 1};
    return hlr::draw(scene.scene(), {}, view, {}, {})->counters.face_tests;
  };
  EXPECT_LE(tests_of(200), 11 * tests_of(20));
}

}  // namespace
}  // namespace strake
