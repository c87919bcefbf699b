// SPDX-License-Identifier: Apache-2.0
// Which objects lie so far from all others that they decide the scale of a view.
#include "drawing/layout/far_objects.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "strake/geometry/primitive.hpp"

namespace strake::drawing {
namespace {

using geometry::Vec3d;
using Indices = std::vector<std::size_t>;

PlaneBox square(double x, double y, double side = 10) { return {x, x + side, y, y + side}; }

/// A field of so many squares of 10 x 10, 20 apart, ten in a row.
std::vector<PlaneBox> field(std::size_t count) {
  std::vector<PlaneBox> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t row = i / 10;
    boxes.push_back(square(20 * static_cast<double>(i % 10), 20 * static_cast<double>(row)));
  }
  return boxes;
}

TEST(FarBoxes, AFieldHasNone) {
  for (const std::size_t count : {0U, 1U, 2U, 4U, 5U, 50U, 3000U})
    EXPECT_EQ(far_boxes(field(count)), Indices{}) << count;
}

TEST(FarBoxes, TheOneThatMakesTheViewMoreThanTwoAndAHalfTimesAsLarge) {
  // The field is 190 x 90.
  auto boxes = field(50);
  boxes.insert(boxes.begin() + 7, square(480, 0));
  EXPECT_EQ(far_boxes(boxes), Indices{7});
  boxes[7] = square(460, 0);  // 470 <= 2.5 x 190
  EXPECT_EQ(far_boxes(boxes), Indices{});
  boxes[7] = square(0, -1000);
  EXPECT_EQ(far_boxes(boxes), Indices{7});
}

TEST(FarBoxes, ThoseOnOppositeSidesAndThoseBehindOthers) {
  auto boxes = field(50);
  boxes.push_back(square(-3000, 0));
  boxes.push_back(square(3000, 0));
  EXPECT_EQ(far_boxes(boxes), (Indices{50, 51}));
  // Without the first the view is still decided by one: the same is asked of the rest.
  boxes.push_back(square(0, 1e6));
  EXPECT_EQ(far_boxes(boxes), (Indices{52, 50, 51}));
}

TEST(FarBoxes, OnlyAFewAreFar) {
  auto boxes = field(50);
  for (int i = 0; i < 10; ++i) boxes.push_back(square(5000 + 20 * i, 0));
  EXPECT_EQ(far_boxes(boxes).size(), 10U);
  boxes.push_back(square(5200, 0));
  EXPECT_EQ(far_boxes(boxes), Indices{}) << "eleven are a part of the plant";
  // Of 20,000 and more, one in a thousand.
  auto many = field(19'980);
  for (int i = 0; i < 20; ++i) many.push_back(square(1e7 + 20 * i, 0));
  EXPECT_EQ(far_boxes(many).size(), 20U);
  // Of four nobody can tell which is the far one.
  EXPECT_EQ(far_boxes(std::vector{square(0, 0), square(20, 0), square(40, 0), square(9000, 0)}),
            Indices{});
}

TEST(FarBoxes, WhatReachesFarIsNotFar) {
  auto boxes = field(50);
  boxes.push_back({-5000, 5000, -5000, 5000});  // the ground
  boxes.push_back({0, 9000, 40, 50});           // a pipe that leaves the plant
  EXPECT_EQ(far_boxes(boxes), Indices{});
}

TEST(FarBoxes, EmptyBoxesTakeNoPart) {
  auto boxes = field(50);
  boxes.insert(boxes.begin(), kNoPlaneBox);
  boxes.push_back(square(1e9, 0));
  EXPECT_EQ(far_boxes(boxes), Indices{51});
}

/// Cubes of 1 m in a row along x, the last one so far off along y.
model::Model row_with_one_off(double y_mm) {
  model::Model model;
  model.files.emplace_back();
  model.files[0].label = "a.rvm";
  model.shapes.emplace_back(geometry::BoxPrimitive{1000, 1000, 1000});
  for (std::uint32_t i = 0; i < 6; ++i) {
    model.objects.emplace_back();
    model.objects[i].id = model.objects[i].name = "BOX " + std::to_string(i);
    model.objects[i].first_body = i;
    model.objects[i].body_count = 1;
    model.bodies.emplace_back();
    model.bodies[i].placement.translation = i == 5 ? Vec3d{0, y_mm, 0} : Vec3d{1500.0 * i, 0, 0};
  }
  return model;
}

hlr::View from_above() {
  hlr::View top;
  top.direction = {0, 0, 1};
  top.up = {0, 1, 0};
  return top;
}

TEST(FarObjects, AreNamedWithTheirDistance) {
  const model::Model model = row_with_one_off(2'501'000);
  const auto scene = model::make_scene(model, {}, {});
  ASSERT_TRUE(scene);
  const auto far = find_far_objects(*scene, {}, from_above(), {});
  ASSERT_TRUE(far);
  EXPECT_EQ(far->objects, std::vector{model::ObjectId{5}});
  EXPECT_DOUBLE_EQ(far->distance_mm, 2'500'000);
  EXPECT_DOUBLE_EQ(far->rest.width(), 7000);
  EXPECT_DOUBLE_EQ(far->whole.height(), 2'502'000);
  EXPECT_EQ(far_objects_text(*far, model), "'BOX 5' (a.rvm) lies 2.50 km from the rest");
  std::vector<bool> drawn;
  leave_out(*far, model, drawn);
  EXPECT_EQ(drawn, (std::vector{true, true, true, true, true, false}));
}

TEST(FarObjects, AreThoseOfTheView) {
  const model::Model model = row_with_one_off(2'501'000);
  const auto scene = model::make_scene(model, {}, {});
  ASSERT_TRUE(scene);
  const auto count = [&](const hlr::View& view, const std::vector<bool>& drawn = {}) {
    const auto far = find_far_objects(*scene, drawn, view, {});
    EXPECT_TRUE(far);
    return far ? far->objects.size() : 99;
  };
  EXPECT_EQ(count(from_above()), 1U);
  EXPECT_EQ(count(from_above(), {true, true, true, true, true, false}), 0U);
  hlr::View view = from_above();
  view.direction = {0, -1, 0};  // along the far way
  view.up = {0, 0, 1};
  EXPECT_EQ(count(view), 0U);
  view = from_above();
  view.limits =
      geometry::Box3l{{-1'000'000, -1'000'000, -1'000'000}, {9'000'000, 9'000'000, 9'000'000}};
  EXPECT_EQ(count(view), 0U);
  view = from_above();
  view.sections = {{{0, 1, 0}, {0, 9'000'000, 0}}};
  EXPECT_EQ(count(view), 0U);
  view = from_above();
  view.perspective = hlr::Perspective{{0, 0, 20'000'000}, {0, 0, 0}};
  EXPECT_EQ(count(view), 0U);
  EXPECT_EQ(find_far_objects(*scene, {true}, from_above(), {}).error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace strake::drawing
