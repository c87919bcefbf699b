// SPDX-License-Identifier: Apache-2.0
// Break lines across what limits cut. Boxes are seen from the front at 1:10: x to the right, z up.
#include "strake/drawing/break_lines.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "strake/geometry/grid.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/team.hpp"

namespace strake::drawing {
namespace {

using geometry::Vec3d;

class Boxes {
 public:
  Boxes() { model_.files.push_back({"t.rvm", "RVM", "mm", "z", 1, 0}); }

  Boxes& add(const Vec3d& middle, const Vec3d& size) {
    model::Object object;
    object.id = object.name = "o" + std::to_string(model_.objects.size());
    object.first_body = static_cast<std::uint32_t>(model_.bodies.size());
    object.body_count = 1;
    model_.objects.push_back(object);
    model::Body body;
    body.shape = model::ShapeId{static_cast<std::uint32_t>(model_.shapes.size())};
    body.placement.translation = middle;
    model_.bodies.push_back(body);
    model_.shapes.emplace_back(geometry::Primitive(geometry::BoxPrimitive{size.x, size.y, size.z}));
    return *this;
  }

  /// Limits from -1 m to 1 m in x, and far in y and z.
  [[nodiscard]] std::vector<BreakLine> lines(const geometry::Vec3l& direction = {0, -1, 0},
                                             const parallel::Context& context = {},
                                             double scale = 10) const {
    const auto scene = model::make_scene(model_, {}, {}).value();
    hlr::View view{direction};
    view.limits = geometry::Box3l{*geometry::snap(Vec3d{-1000, -9000, -9000}),
                                  *geometry::snap(Vec3d{1000, 9000, 9000})};
    hlr::Options options;
    options.hidden = false;
    const auto drawn = hlr::draw(scene, {}, view, options, {});
    EXPECT_TRUE(drawn);
    const auto laid_out = lay_out(*drawn, model_, {.scale = scale}, {});
    EXPECT_TRUE(laid_out);
    auto found = find_break_lines(*laid_out, context);
    EXPECT_TRUE(found);
    return std::move(found).value();
  }

 private:
  model::Model model_;
};

double length_between_ends(const BreakLine& line) {
  return std::hypot(line.points.back().x - line.points.front().x,
                    line.points.back().y - line.points.front().y);
}

TEST(BreakLines, AcrossABeamThatBothSidesCut) {
  const auto lines = Boxes().add({0, 0, 0}, {4000, 100, 200}).lines();
  ASSERT_EQ(lines.size(), 2U);
  for (const BreakLine& line : lines) {
    // 20 mm high on paper, and 2 mm more at each end; upright, with one zigzag.
    EXPECT_NEAR(length_between_ends(line), 24, 0.01);
    EXPECT_NEAR(line.points.front().x, line.points.back().x, 0.001);
    EXPECT_EQ(line.points.size(), 6U);
  }
  EXPECT_NEAR(std::fabs(lines[0].points[0].x - lines[1].points[0].x), 200, 0.01);
}

TEST(BreakLines, WhatEndsAtTheLimitsIsNotCut) {
  EXPECT_TRUE(Boxes().add({0, 0, 0}, {2000, 100, 200}).lines().empty());
  EXPECT_TRUE(Boxes().add({0, 0, 0}, {1000, 100, 200}).lines().empty());
}

TEST(BreakLines, ObjectsThatMeetShareOne) {
  Boxes boxes;
  boxes.add({1000, 0, 0}, {1000, 100, 200}).add({1000, 0, 150}, {1000, 100, 100});
  const auto lines = boxes.lines();
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(length_between_ends(lines[0]), 30 + 4, 0.01);
  EXPECT_EQ(lines[0].object, model::ObjectId{0});
  // Apart they have their own.
  EXPECT_EQ(boxes.add({1000, 0, 900}, {1000, 100, 100}).lines().size(), 2U);
}

TEST(BreakLines, LongOnesHaveSeveralZigzags) {
  const auto lines = Boxes().add({1000, 0, 0}, {1000, 100, 2000}).lines();
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].points.size(), 2U + 4U * 3U);
}

// 20 km of paper: a zigzag each 80 mm would be 250,000 of them.
TEST(BreakLines, HowManyZigzagsThereAreIsBounded) {
  const auto lines = Boxes().add({1000, 0, 0}, {1000, 100, 2000}).lines({0, -1, 0}, {}, 0.0001);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].points.size(), 2U + 4U * 100U);
}

TEST(BreakLines, NarrowOnesHaveSmallZigzags) {
  const auto lines = Boxes().add({1000, 0, 0}, {1000, 100, 10}).lines();
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(length_between_ends(lines[0]), 2, 0.01);
  for (const PaperPoint& p : lines[0].points)
    EXPECT_LE(std::fabs(p.x - lines[0].points[0].x), 0.35);
}

// The side is seen square from the right, and askew in the isometric view.
TEST(BreakLines, SidesSeenSquareHaveNoneAndAskewOneForEachObject) {
  Boxes boxes;
  boxes.add({0, 0, 0}, {4000, 100, 200}).add({0, 0, 150}, {4000, 100, 100});
  EXPECT_TRUE(boxes.lines({1, 0, 0}).empty());
  const auto askew = boxes.lines({1, -1, 1});
  EXPECT_GE(askew.size(), 2U);
  for (const BreakLine& line : askew) EXPECT_GE(line.points.size(), 6U);
}

TEST(BreakLines, TheTeamDecidesNothing) {
  Boxes boxes;
  for (int i = 0; i < 50; ++i) boxes.add({0, 0, i * 300.0}, {4000, 100.0 + i, 100});
  const auto alone = boxes.lines();
  EXPECT_EQ(alone.size(), 60U);  // those within 9 m, both sides
  parallel::Team team(4);
  const auto some = boxes.lines({0, -1, 0}, {.team = &team});
  ASSERT_EQ(some.size(), alone.size());
  for (std::size_t i = 0; i < alone.size(); ++i) EXPECT_EQ(some[i].points, alone[i].points);
}

}  // namespace
}  // namespace strake::drawing
