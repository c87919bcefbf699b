// SPDX-License-Identifier: Apache-2.0
// Where bodies end, and which ends meet.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "model/ends/end_joints.hpp"
#include "model/ends/primitive_ends.hpp"
#include "strake/parallel/team.hpp"
#include "support/clash_model.hpp"
#include "support/revolved_meshes.hpp"
#include "support/rotations.hpp"

namespace strake::model {
namespace {

using geometry::Placement;
using geometry::Vec3d;
using test::ClashModel;

std::vector<ObjectEnd> ends(const ClashModel& m) {
  const Scene scene = make_scene(m.model, {}, {}).value();
  return ends_of(scene, std::vector<bool>(m.model.objects.size(), true));
}

std::vector<ObjectEnd> ends_of_one(Shape shape, const Placement& placement = {}) {
  return ends(ClashModel().object("one").body(std::move(shape), placement));
}

/// That these are the ends, in any order: places in millimetres, to 5 µm and a thousandth.
void expect_ends(const std::vector<ObjectEnd>& got,
                 const std::vector<std::pair<Vec3d, Vec3d>>& expected) {
  ASSERT_EQ(got.size(), expected.size());
  for (const auto& [at, outward] : expected) {
    bool found = false;
    for (const ObjectEnd& end : got) {
      const Vec3d off = end.at.as<double>() - at * 1000, turn = end.outward - outward;
      found = found || (dot(off, off) <= 25 && dot(turn, turn) <= 1e-6);
    }
    EXPECT_TRUE(found) << at.x << ' ' << at.y << ' ' << at.z;
  }
}

TEST(Ends, OfPrimitives) {
  using namespace geometry;
  const Vec3d up{0, 0, 1}, down{0, 0, -1};
  expect_ends(ends_of_one(CylinderPrimitive{50, 1000}), {{{0, 0, -500}, down}, {{0, 0, 500}, up}});
  expect_ends(ends_of_one(CircularTorusPrimitive{150, 50, std::numbers::pi / 2}),
              {{{150, 0, 0}, {0, -1, 0}}, {{0, 150, 0}, {-1, 0, 0}}});
  expect_ends(ends_of_one(RectangularTorusPrimitive{100, 200, 80, std::numbers::pi}),
              {{{150, 0, 0}, {0, -1, 0}}, {{-150, 0, 0}, {0, -1, 0}}});
  EXPECT_TRUE(ends_of_one(CircularTorusPrimitive{150, 50, 2 * std::numbers::pi}).empty());
  expect_ends(ends_of_one(SnoutPrimitive{50, 25, 200, 20, 10}),
              {{{-10, -5, -100}, down}, {{10, 5, 100}, up}});
  expect_ends(ends_of_one(SnoutPrimitive{50, 0, 200}), {{{0, 0, -100}, down}});
  const double half = std::sqrt(0.5);
  expect_ends(ends_of_one(SnoutPrimitive{.bottom_radius = 50,
                                         .top_radius = 50,
                                         .height = 400,
                                         .top_shear_x = std::numbers::pi / 4}),
              {{{0, 0, -200}, down}, {{0, 0, 200}, {-half, 0, half}}});
  expect_ends(ends_of_one(EllipticalDishPrimitive{50, 25}), {{{0, 0, 0}, down}});
  expect_ends(ends_of_one(SphericalDishPrimitive{50, 25}), {{{0, 0, 0}, down}});
  EXPECT_TRUE(ends_of_one(SpherePrimitive{100}).empty());
  expect_ends(ends_of_one(BoxPrimitive{100, 2000, 200}),
              {{{0, -1000, 0}, {0, -1, 0}}, {{0, 1000, 0}, {0, 1, 0}}});
  EXPECT_TRUE(ends_of_one(BoxPrimitive{1000, 1000, 10}).empty()) << "a square plate";
  expect_ends(ends_of_one(PyramidPrimitive{100, 100, 50, 50, 20, 0, 200}),
              {{{-10, 0, -100}, down}, {{10, 0, 100}, up}});
  expect_ends(ends_of_one(PyramidPrimitive{100, 100, 0, 50, 0, 0, 200}), {{{0, 0, -100}, down}});
}

TEST(Ends, FollowThePlacement) {
  const Placement turned{test::kTurn, {1000, 2000, 3000}};
  const Vec3d axis = test::kTurn * Vec3d{0, 0, 1};
  expect_ends(ends_of_one(geometry::CylinderPrimitive{50, 1000}, turned),
              {{turned * Vec3d{0, 0, -500}, -axis}, {turned * Vec3d{0, 0, 500}, axis}});
  // A mirrored one points out as well.
  const Placement mirrored{{{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, -1}}}, {}};
  expect_ends(ends_of_one(geometry::EllipticalDishPrimitive{50, 25}, mirrored),
              {{{0, 0, 0}, {0, 0, 1}}});
}

/// A tube round z from 0 to `height`, with rings at its ends if it has a wall.
geometry::TriangleMesh tube(double outer, double inner, double height, std::uint32_t sectors,
                            bool rings) {
  geometry::TriangleMesh m;
  for (std::uint32_t s = 0; s < sectors; ++s) {
    const double angle = 2 * std::numbers::pi * s / sectors, x = std::cos(angle),
                 y = std::sin(angle);
    m.vertices.push_back({outer * x, outer * y, 0});
    m.vertices.push_back({outer * x, outer * y, height});
    m.vertices.push_back({inner * x, inner * y, 0});
    m.vertices.push_back({inner * x, inner * y, height});
  }
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    m.triangles.push_back({a, b, c});
    m.triangles.push_back({a, c, d});
  };
  for (std::uint32_t s = 0; s < sectors; ++s) {
    const std::uint32_t a = 4 * s, b = 4 * ((s + 1) % sectors);
    quad(a, b, b + 1, a + 1);
    if (!rings) continue;
    quad(a + 2, a + 3, b + 3, b + 2);
    quad(a, a + 2, b + 2, b);
    quad(a + 1, b + 1, b + 3, a + 3);
  }
  return m;
}

TEST(Ends, OfFacetedPipes) {
  const Placement turned{test::kTurn, {1000, 2000, 3000}};
  for (const std::uint32_t sectors : {6U, 8U, 17U, 64U}) {
    for (const Placement& placement : {Placement{}, turned}) {
      const Vec3d axis = placement.linear * Vec3d{0, 0, 1};
      const std::vector<std::pair<Vec3d, Vec3d>> both{{placement * Vec3d{0, 0, 0}, -axis},
                                                      {placement * Vec3d{0, 0, 1000}, axis}};
      expect_ends(ends_of_one(test::cylinder_mesh(50, 1000, 3, sectors), placement), both);
      expect_ends(ends_of_one(tube(50, 45, 1000, sectors, true), placement), both);
      expect_ends(ends_of_one(tube(50, 50, 1000, sectors, false), placement), both);
    }
  }
}

TEST(Ends, OfOtherMeshesAreNotKnown) {
  EXPECT_TRUE(ends_of_one(test::box_mesh({0, 0, 0}, {10, 10, 1000})).empty());
  EXPECT_TRUE(ends_of_one(test::cylinder_mesh(50, 1000, 3, 5)).empty()) << "five corners";
  EXPECT_TRUE(ends_of_one(test::sphere_mesh(50, 12)).empty());
  EXPECT_TRUE(ends_of_one(test::sphere_mesh(50, 180)).empty()) << "a degree from facet to facet";
  // An oval, and a bar of half a round.
  const Placement wide{{{Vec3d{1.2, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}}, {}};
  EXPECT_TRUE(ends_of_one(test::cylinder_mesh(50, 1000, 1, 24), wide).empty());
  const auto half = test::revolved(3, 24, [](double t, double angle) {
    const double z = t < 0.5 ? 0 : 1000;
    const bool pole = t <= 0 || t >= 1;
    return Vec3d{pole ? 0 : 50 * std::cos(angle / 2), pole ? 10 : 50 * std::sin(angle / 2), z};
  });
  EXPECT_TRUE(ends_of_one(half).empty());
}

/// How far the bodies reach behind their ends, ascending, to 5 µm of the tessellation.
void expect_reaches(const std::vector<ObjectEnd>& got, std::vector<double> expected_mm) {
  std::vector<double> reaches;
  for (const ObjectEnd& end : got) reaches.push_back(end.reach / 1000);
  std::ranges::sort(reaches);
  ASSERT_EQ(reaches.size(), expected_mm.size());
  for (std::size_t i = 0; i < reaches.size(); ++i) EXPECT_NEAR(reaches[i], expected_mm[i], .005);
}

TEST(Ends, KnowHowFarTheirBodyReaches) {
  const Placement turned{{{Vec3d{1, 0, 0}, Vec3d{0, 0, -1}, Vec3d{0, 1, 0}}}, {1000, 2000, 3000}};
  expect_reaches(ends_of_one(geometry::CylinderPrimitive{50, 1000}, turned), {1000, 1000});
  expect_reaches(ends_of_one(test::cylinder_mesh(50, 1000, 3, 12), turned), {1000, 1000});
  expect_reaches(ends_of_one(geometry::EllipticalDishPrimitive{50, 25}), {25});
  expect_reaches(ends_of_one(geometry::BoxPrimitive{100, 2000, 200}), {2000, 2000});
  expect_reaches(ends_of_one(tube(50, 50, 1000, 12, false)), {1000, 1000});
}

TEST(Ends, AFlatDiscHasNone) {
  EXPECT_TRUE(ends_of_one(geometry::CylinderPrimitive{50, 0}).empty());
  EXPECT_EQ(ends_of_one(geometry::CylinderPrimitive{50, 1}).size(), 2U);
}

TEST(Ends, OnlyOfWhatIsRequestedAndOfPhysicalBodies) {
  ClashModel m;
  m.object("a").body(geometry::CylinderPrimitive{50, 1000});
  m.object("b").again({});
  m.object("c").again({});
  m.model.bodies.back().category = Category::insulation;
  SceneOptions options;
  options.insulation = true;
  const Scene scene = make_scene(m.model, options, {}).value();
  const auto got = ends_of(scene, {false, true, true});
  ASSERT_EQ(got.size(), 2U);
  EXPECT_EQ(got[0].object, 1U);
}

using Joints = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

TEST(EndJoints, ExactlyWithinTheLength) {
  const auto joints = [](std::int64_t apart, std::int64_t within, const Vec3d& other = {0, 0, -1}) {
    return joints_of({{{0, 0, 0}, {0, 0, 1}, 4}, {{apart, 0, 0}, other, 2}}, within, {}).value();
  };
  EXPECT_EQ(joints(5000, 5000), (Joints{{2, 4}}));
  EXPECT_EQ(joints(-5000, 5000), (Joints{{2, 4}}));
  EXPECT_EQ(joints(5001, 5000), Joints{});
  EXPECT_EQ(joints(0, 0), (Joints{{2, 4}}));
  EXPECT_EQ(joints(1, 0), Joints{});
  EXPECT_EQ(joints(0, 5000, {0, 0, 1}), Joints{}) << "they point the same way";
  EXPECT_EQ(joints(0, 5000, {1, 0, 0}), Joints{}) << "at a right angle";
  const double tilt = 29 * std::numbers::pi / 180;
  EXPECT_EQ(joints(0, 5000, {std::sin(tilt), 0, -std::cos(tilt)}), (Joints{{2, 4}}));
  const double more = 31 * std::numbers::pi / 180;
  EXPECT_EQ(joints(0, 5000, {std::sin(more), 0, -std::cos(more)}), Joints{});
}

/// Whether two ends on one axis, the second that far behind the first, join their objects.
bool join_at(double behind, double reach, double other_reach) {
  const auto z = static_cast<std::int64_t>(-1000 * behind);
  return !joints_of({{{0, 0, 0}, {0, 0, 1}, 1, 1000 * reach},
                     {{0, 0, z}, {0, 0, -1}, 2, 1000 * other_reach}},
                    1000000, {})
              .value()
              .empty();
}

TEST(EndJoints, TheBodiesLieOnOppositeSides) {
  EXPECT_TRUE(join_at(-800, 10, 10)) << "a gap";
  EXPECT_TRUE(join_at(10, 1000, 1000));
  EXPECT_TRUE(join_at(10, 20, 1000)) << "in the middle of a coupling";
  EXPECT_TRUE(join_at(10, 1000, 20));
  EXPECT_FALSE(join_at(10.1, 20, 1000));
  EXPECT_FALSE(join_at(10.1, 1000, 20));
  EXPECT_FALSE(join_at(20, 20, 20)) << "a copy";
  EXPECT_FALSE(join_at(17, 20, 20)) << "a copy moved along";
}

/// Two bodies of an object, end to end at z = 0, beside another object whose two meet there too.
TEST(EndJoints, ASeamOfBothObjectsIsNone) {
  const auto joins = [](double below, double above) {
    const double sleeve = 1000;
    return !joints_of({{{0, 0, 0}, {0, 0, 1}, 1, 5000},
                       {{0, 0, 0}, {0, 0, -1}, 1, below},
                       {{0, 0, 0}, {0, 0, 1}, 2, above},
                       {{0, 0, 0}, {0, 0, -1}, 2, sleeve}},
                      1000, {})
                .value()
                .empty();
  };
  EXPECT_FALSE(joins(1000, 5000)) << "a valve and its copy";
  EXPECT_TRUE(joins(100, 5000)) << "the first has a gasket alone behind its end";
  EXPECT_TRUE(joins(100, 100)) << "both have one";
}

TEST(EndJoints, AreThoseOfAllPairsForAnyTeam) {
  std::mt19937 random(29);
  std::vector<ObjectEnd> all;
  const auto coordinate = [&] { return static_cast<std::int64_t>(random() % 40001) - 20000; };
  for (std::uint32_t i = 0; i < 600; ++i) {
    ObjectEnd& end = all.emplace_back();
    end.at = {coordinate(), coordinate(), coordinate()};
    end.outward = {0, 0, random() % 2 == 0 ? 1.0 : -1.0};
    end.object = i % 200;
    end.reach = 1000.0 * static_cast<double>(1 + random() % 9);
  }
  const auto meet = [](const ObjectEnd& x, const ObjectEnd& y, std::int64_t within) {
    const geometry::Vec3l apart = y.at - x.at;
    const double behind = -static_cast<double>(apart.z) * x.outward.z;
    return dot(apart, apart) <= within * within && dot(x.outward, y.outward) < 0 &&
           2 * behind <= std::min(x.reach, y.reach) + 4;
  };
  const auto own = [&](const ObjectEnd& x, std::int64_t within) {
    double reach = -10;
    for (const ObjectEnd& y : all)
      if (y.object == x.object && meet(x, y, within)) reach = std::max(reach, y.reach);
    return reach;
  };
  parallel::Team team(3);
  for (const std::int64_t within : {std::int64_t{1}, std::int64_t{997}, std::int64_t{4000}}) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> expected;
    for (const ObjectEnd& x : all)
      for (const ObjectEnd& y : all)
        if (x.object < y.object && meet(x, y, within) &&
            (own(x, within) + 4 < y.reach || own(y, within) + 4 < x.reach))
          expected.insert({x.object, y.object});
    const Joints sorted(expected.begin(), expected.end());
    EXPECT_EQ(joints_of(all, within, {}).value(), sorted);
    EXPECT_EQ(joints_of(all, within, {.team = &team}).value(), sorted);
  }
}

}  // namespace
}  // namespace strake::model
